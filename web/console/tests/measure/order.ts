// Is no test: looks for an order of the modules in which the script is smaller with gzip, and writes src/order.ts. Begins with the order of now.
// cd web/console && npx vite-node tests/measure/order.ts [SECONDS]
import { writeFileSync } from 'node:fs';
import { relative, resolve } from 'node:path';
import { gzipSync } from 'node:zlib';
import { build, type Plugin } from 'vite';

const until = Date.now() + 1000 * Number(process.argv[2] ?? 300);
const source = resolve('src');
const imports = new Map<string, readonly string[]>();
let script = '';

// Ends each module with a statement that minifying leaves, so that its part of the script can be told.
const marks: Plugin = {
  name: 'marks',
  enforce: 'post',
  transform: (code, id) => (/\.(css|xml|html)/.test(id) ? undefined : { code: `${code}\n;globalThis.mark(${JSON.stringify(id)});`, map: null, moduleSideEffects: true }),
  generateBundle(_, bundle) {
    for (const id of this.getModuleIds()) imports.set(id, this.getModuleInfo(id)!.importedIds);
    for (const file of Object.values(bundle)) if (file.type === 'chunk') script = file.code;
  },
};
await build({ logLevel: 'error', build: { write: false }, plugins: [marks] });

const pieces = script.split(/globalThis\.mark\("([^"]+)"\);?/);
const parts = new Map<string, string>();
for (let i = 0; i + 1 < pieces.length; i += 2) parts.set(pieces[i + 1]!, pieces[i]!);
let order = [...parts.keys()];
const places = (those: readonly string[]) => new Map(those.map((id, i) => [id, i]));
const size = (those: readonly string[]) => gzipSync(those.map((id) => parts.get(id)).join(''), { level: 9 }).length;

// What has to stand before a module: what it imports, through modules that are nothing but imports, too; but for circles.
const before = new Map<string, string[]>();
const now = places(order);
for (const id of order) {
  const found = new Set<string>();
  const look = (one: string): void => {
    for (const other of imports.get(one) ?? []) {
      if (found.has(other)) continue;
      found.add(other);
      if (!parts.has(other)) look(other);
    }
  };
  look(id);
  before.set(id, [...found].filter((other) => (now.get(other) ?? Infinity) < now.get(id)!));
}
const after = new Map<string, string[]>(order.map((id) => [id, order.filter((other) => before.get(other)!.includes(id))]));

// A few neighbours at a time are put elsewhere; what is not smaller is taken back.
let seed = 1;
const dice = (n: number) => Math.floor(((seed = (seed * 1_103_515_245 + 12_345) & 0x7fffffff) / 0x80000000) * n);
let least = size(order);
console.log(least);
while (Date.now() < until) {
  const from = dice(order.length);
  const moved = order.slice(from, from + 1 + Math.max(0, dice(8) - 2));
  const rest = order.filter((id) => !moved.includes(id));
  const at = places(rest);
  const first = Math.max(0, ...moved.flatMap((id) => before.get(id)!.map((other) => (at.get(other) ?? -1) + 1)));
  const last = Math.min(rest.length, ...moved.flatMap((id) => after.get(id)!.map((other) => at.get(other) ?? Infinity)));
  if (first > last) continue;
  const to = first + dice(last - first + 1);
  const next = [...rest.slice(0, to), ...moved, ...rest.slice(to)];
  const bytes = size(next);
  if (bytes > least) continue;
  [order, least] = [next, bytes];
}
console.log(least);

const own = order.map((id) => relative(source, id)).filter((name) => !name.startsWith('.') && name !== 'main.tsx' && name !== 'order.ts');
writeFileSync(
  'src/order.ts',
  `// In which order modules stand in the page: so they are smaller with gzip, which knows the last 32 KiB (docs/console.md).
// Written by tests/measure/order.ts. Whatever is not named here is there all the same.
${own.map((name) => `import './${name.replace(/\.tsx?$/, '')}';\n`).join('')}`,
);
