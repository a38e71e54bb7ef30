// What makes the built page light besides leaving things out; docs/console.md says how much each brings.
import { readFileSync } from 'node:fs';

import { minify } from 'terser';
import type { Plugin } from 'vite';

/** What tests ask the page for, and developer tools, keeps its name: classes and members. */
export const kept = new Set(`
  app-main button-danger component-list conditions-add conditions-chips conditions-count conditions-found conditions-picker conditions-radio
  conditions-subscription conditions-tools engine-component engine-ref exchange-came field-error floor-ground health-figures health-legend health-log
  health-plot link-age link-mark map-bar map-canvas map-fact map-floor map-form map-motion map-pointer map-scale map-switch scenario-edge-last scenario-panel
  scenario-printed scenario-value sequence-add sequence-add-branch sequence-beginning sequence-box sequence-branch sequence-choices
  sequence-fields sequence-form sequence-lane sequence-last sequence-parallel sequence-target sequence-title sequence-toolbar sequence-whole
  tabs-row timeline-canvas timeline-frame timeline-listing timeline-name timeline-place timeline-tip virtual-list virtual-list-row
  visitors-body visitors-entering visitors-floor visitors-one visitors-orders xml-line xml-name
  as_own borrow borrow_any selection traffic
`.match(/[\w-]+/g));

type Node = Record<string, unknown> & { type: string };

/** Members of classes that are named nowhere but after a dot: in no object that is written down, and in no text. */
function own_members(program: unknown): string[] {
  const members = new Set<string>();
  const others = new Set<string>(kept);
  const name_of = (key: unknown) => String((key as Node).name);
  const visit = (part: unknown): void => {
    if (Array.isArray(part)) part.forEach(visit);
    if (typeof part !== 'object' || part === null || !('type' in part)) return;
    const node = part as Node;
    const assigned = node.type === 'AssignmentExpression' ? (node['left'] as Node) : undefined;
    if (node.type === 'MethodDefinition' || node.type === 'PropertyDefinition') members.add(name_of(node['key']));
    if ((assigned?.['object'] as Node | undefined)?.type === 'ThisExpression') members.add(name_of(assigned!['property']));
    if (node.type === 'ObjectExpression') for (const { key } of node['properties'] as Node[]) if (key) others.add(name_of(key));
    const text = node.type === 'TemplateElement' ? (node['value'] as { cooked: string }).cooked : node.type === 'Literal' ? String(node['value']) : '';
    for (const word of text.match(/[\w$]+/g) ?? []) others.add(word);
    Object.values(node).forEach(visit);
  };
  visit(program);
  return [...members].filter((name) => /^[a-z]\w/.test(name) && !others.has(name));
}

/** Instead of Vite's own minifying of scripts. `let` alone is less than `let` and `const`. */
export const scripts: Plugin = {
  name: 'scripts',
  renderChunk: {
    order: 'post',
    async handler(code) {
      const properties = { regex: new RegExp(`^(${own_members(this.parse(code)).join('|')})$`) };
      const compress = { passes: 3, inline: 1, sequences: false, lhs_constants: false } as object;
      const small = await minify(code.replace(/^( *)const /gm, '$1let '), { module: true, ecma: 2020, compress, mangle: { properties } });
      return { code: small.code!, map: null };
    },
  },
};

/** The shipped scenario without its comments, which the page shows nowhere. */
export const documents: Plugin = {
  name: 'documents',
  enforce: 'pre',
  load(id) {
    if (!id.endsWith('.xml?raw')) return undefined;
    const text = readFileSync(id.slice(0, -'?raw'.length), 'utf8').replace(/ *<!--[^]*?-->/g, '');
    return `export default ${JSON.stringify(text)}`;
  },
};

/** Short names for classes, in scripts and style sheets, but for those that scripts put together. */
export const styles: Plugin = {
  name: 'styles',
  generateBundle: {
    order: 'post',
    handler(_, bundle) {
      const files = Object.values(bundle);
      const script = files.map((file) => (file.type === 'chunk' ? file.code : '')).join('\n');
      const begun = [...script.matchAll(/([a-z]+-(?:[a-z]+-)*)\$\{/g)].map(([, text]) => text!);
      const names = new Map<string, string>();
      const short = (name: string) => {
        if (kept.has(name) || begun.some((text) => name.startsWith(text))) return name;
        if (!names.has(name)) names.set(name, `_${names.size.toString(36)}`);
        return names.get(name)!;
      };
      for (const file of files)
        if (file.type === 'asset' && file.fileName.endsWith('.css'))
          file.source = String(file.source).replace(/(?<=\.)[a-z]+(-[a-z]+)+(?![\w-])/g, short);
      for (const file of files)
        if (file.type === 'chunk') file.code = file.code.replace(/(?<=["'`. ])[a-z]+(-[a-z]+)+(?=["'`. [:>])/g, (name) => names.get(name) ?? name);
    },
  },
};
