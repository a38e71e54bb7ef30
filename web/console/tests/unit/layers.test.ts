// The rooms of src/ and their imports (docs/console.md).
import { readdirSync, readFileSync } from 'node:fs';
import { dirname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';

import { describe, expect, test } from 'vitest';

const source = fileURLToPath(new URL('../../src', import.meta.url));
const files = readdirSync(source, { recursive: true, encoding: 'utf8' });
const modules = files.filter((file) => /\.tsx?$/.test(file)).map((file) => normalize(file));

// Imports of each module, type-only and lazy ones included.
const imports = new Map(modules.map((module) => [module, imports_of(module)]));

function imports_of(module: string): string[] {
  const found = readFileSync(join(source, module), 'utf8').matchAll(/(?:\bfrom|\bimport\()\s*'(\.[^']+)'/g);
  return [...found].flatMap(([, path]) => {
    const target = normalize(join(dirname(module), path!));
    return modules.filter((one) => [`${target}.ts`, `${target}.tsx`, join(target, 'index.ts')].includes(one));
  });
}

/** The first room of a module: `map` for `map/painting/pen.ts`, `main.tsx` for itself. */
function room_of(module: string): string {
  return module.split('/')[0]!;
}

function cycles_in(graph: ReadonlyMap<string, readonly string[]>): string[] {
  const done = new Set<string>();
  const visit = (node: string, path: readonly string[]): string[] => {
    if (path.includes(node)) return [[...path.slice(path.indexOf(node)), node].join(' -> ')];
    if (done.has(node)) return [];
    const cycles = graph.get(node)!.flatMap((used) => visit(used, [...path, node]));
    done.add(node);
    return cycles;
  };
  return [...graph.keys()].flatMap((node) => visit(node, []));
}

// Besides modules of its own room, a module of the room imports only these rooms and modules.
const panel = ['state', 'context', 'i18n', 'ui', 'forms', 'shell/navigation', 'shell/panel_titles', 'shell/theme', 'shell/texts'];
const may_use: Record<string, string[]> = {
  state: [],
  'context.ts': ['state'],
  i18n: [],
  ui: ['context', 'i18n', 'state/floor', 'state/base/reason_of', 'state/notices'],
  shell: ['state', 'context', 'i18n', 'ui'],
  forms: ['state', 'context', 'i18n', 'ui', 'shell/navigation'],
  'panels.ts': ['shell', ...readdirSync(source).map((room) => `${room}/panel`)],
  'main.tsx': ['state', 'i18n', 'shell', 'panels'],
};

describe('modules', () => {
  test('import only from the rooms below', () => {
    expect(imports.get('panels.ts')).toContain('map/panel.tsx');
    const wrong = modules.flatMap((module) => {
      const room = room_of(module);
      const allowed = [room, ...(may_use[room] ?? panel)];
      const is_allowed = (used: string) => allowed.some((one) => used.startsWith(`${one}/`) || used.startsWith(`${one}.`));
      return imports.get(module)!.filter((used) => !is_allowed(used)).map((used) => `${module} imports ${used}`);
    });
    expect(wrong).toEqual([]);
  });

  test('of panels and forms import widgets from ui/index.ts', () => {
    const rooms = ['forms', ...modules.filter((one) => one.endsWith('/panel.tsx')).map(room_of)];
    const wrong = modules.filter((one) => rooms.includes(room_of(one))).flatMap((module) => {
      const parts = imports.get(module)!.filter((used) => room_of(used) === 'ui' && used !== 'ui/index.ts');
      return parts.map((used) => `${module} imports ${used}`);
    });
    expect(wrong).toEqual([]);
  });

  test('have no import cycle, not even of types; nor have rooms', () => {
    const rooms = new Map<string, string[]>();
    for (const [module, used] of imports) {
      const room = room_of(module);
      rooms.set(room, [...(rooms.get(room) ?? []), ...used.map(room_of).filter((other) => other !== room)]);
    }
    expect(cycles_in(imports)).toEqual([]);
    expect(cycles_in(rooms)).toEqual([]);
  });

  test('stand in rooms of at most 25 files', () => {
    const sizes = new Map<string, number>();
    for (const file of files.filter((one) => /\.(tsx?|css)$/.test(one))) sizes.set(dirname(file), (sizes.get(dirname(file)) ?? 0) + 1);
    expect([...sizes].filter(([, size]) => size > 25)).toEqual([]);
  });
});
