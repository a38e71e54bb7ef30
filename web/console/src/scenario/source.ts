// A scenario's text with the positions of its elements. Edits change only their own part; comments and layout stay.
import { escape_attribute, escape_text, parse_xml, type XmlElement } from 'rois-client';

interface Span {
  start: number;
  end: number;
}

/** An element with its position; offsets refer to the text that was read. */
export interface Node extends Span {
  element: XmlElement;
  name: string;
  parent: Node | undefined;
  children: Node[];
  /** Position in the tree: `0/3/1`. */
  path: string;
  written: string; // its name with prefix
  open_end: number; // after the `>` of its start tag
  close: number; // start of its end tag; `open_end` if there is none
  is_closed: boolean; // `<name/>`
  attributes: Map<string, Span>; // from the name to the closing quote
}

/** As parse_xml expects: lines end in LF, no byte order mark. */
export function plain_lines(text: string): string {
  return text.replace(/^\uFEFF/, '').replace(/\r\n?/g, '\n');
}

const start_tag = /<([^\s<>/]+)((?:[^"'<>]|"[^"]*"|'[^']*')*)>/y;
const an_attribute = /([^\s=]+)\s*=\s*("[^"]*"|'[^']*')/g;

/** Throws XmlError if the text is not well-formed. */
export function read_source(text: string): Node {
  const root = parse_xml(text);
  const open: Node[] = [];
  let first: Node | undefined;
  for (let at = text.indexOf('<'); at >= 0; at = text.indexOf('<', at)) {
    if (text.startsWith('<!--', at)) at = text.indexOf('-->', at) + 3;
    else if (text.startsWith('<![CDATA[', at)) at = text.indexOf(']]>', at) + 3;
    else if (text.startsWith('<?', at)) at = text.indexOf('?>', at) + 2;
    else if (text.startsWith('</', at)) {
      const node = open.pop()!;
      node.close = at;
      at = node.end = text.indexOf('>', at) + 1;
    } else {
      const parent = open.at(-1);
      const node = node_at(text, at, parent, parent ? parent.element.children[parent.children.length]! : root);
      parent?.children.push(node);
      first ??= node;
      if (!node.is_closed) open.push(node);
      at = node.open_end;
    }
  }
  return first!;
}

function node_at(text: string, at: number, parent: Node | undefined, element: XmlElement): Node {
  start_tag.lastIndex = at;
  const [whole, written, inside] = start_tag.exec(text) as unknown as [string, string, string];
  const end = at + whole.length;
  const attributes = new Map<string, Span>();
  for (const found of inside.matchAll(an_attribute)) {
    const start = at + 1 + written.length + found.index;
    attributes.set(found[1]!, { start, end: start + found[0].length });
  }
  const path = parent ? `${parent.path}/${parent.children.length}` : '0';
  return {
    element,
    name: element.name,
    parent,
    children: [],
    path,
    written,
    start: at,
    open_end: end,
    close: end,
    end,
    is_closed: inside.endsWith('/'),
    attributes,
  };
}

/** From 1, as in editors. */
export function line_and_column(text: string, offset: number): { line: number; column: number } {
  const before = text.slice(0, offset);
  return { line: before.split('\n').length, column: offset - before.lastIndexOf('\n') };
}

/** All elements inside, itself first. */
export function* nodes_in(node: Node): Generator<Node> {
  yield node;
  for (const child of node.children) yield* nodes_in(child);
}

// --- Edits. Each returns the new text; nodes refer to the old one. ---

function replaced(text: string, { start, end }: Span, by: string): string {
  return text.slice(0, start) + by + text.slice(end);
}

/** `undefined` removes the attribute. */
export function with_attribute(text: string, node: Node, name: string, value: string | undefined): string {
  const attribute = node.attributes.get(name);
  const written = value === undefined ? '' : `${name}="${escape_attribute(value)}"`;
  if (attribute && value !== undefined) return replaced(text, attribute, written);
  if (attribute)
    return replaced(text, { start: attribute.start - /\s*$/.exec(text.slice(0, attribute.start))![0].length, end: attribute.end }, '');
  if (value === undefined) return text;
  const tag = text.slice(node.start, node.open_end - (node.is_closed ? 2 : 1)).trimEnd();
  return replaced(text, { start: node.start, end: node.start + tag.length }, `${tag} ${written}`);
}

/** The text of an element without children. */
export function with_text(text: string, node: Node, value: string): string {
  const tag = text.slice(node.start, node.open_end - (node.is_closed ? 2 : 1)).trimEnd();
  return replaced(text, node, value === '' ? `${tag}/>` : `${tag}>${escape_text(value)}</${node.written}>`);
}

/** Removes the element, with its line if it is alone there. */
export function without(text: string, node: Node): string {
  const before = /\n[ \t]*$/.exec(text.slice(0, node.start))?.[0].length ?? 0;
  const is_alone = /^[ \t]*(\n|$)/.test(text.slice(node.end)) || text.startsWith('<', node.end);
  return replaced(text, { start: node.start - (is_alone ? before : 0), end: node.end }, '');
}

/** Inserts an element, given as XML, before a child or at the end. */
export function with_child(text: string, parent: Node, xml: string, before?: Node): string {
  const indent = (at: number) => /(?:^|\n)([ \t]*)[^\n]*$/.exec(text.slice(0, at))![1]!;
  if (before) return replaced(text, { start: before.start, end: before.start }, `${xml}\n${indent(before.start)}`);
  const inside = `\n${indent(parent.start)}  ${xml.replaceAll('\n', `\n${indent(parent.start)}  `)}`;
  if (parent.is_closed) {
    const tag = text.slice(parent.start, parent.open_end - 2).trimEnd();
    return replaced(text, parent, `${tag}>${inside}\n${indent(parent.start)}</${parent.written}>`);
  }
  const last = parent.children.at(-1)?.end ?? parent.open_end;
  const has_line = /^\s*\n/.test(text.slice(last, parent.close));
  return replaced(text, { start: last, end: last }, inside + (has_line ? '' : `\n${indent(parent.start)}`));
}

/** Swaps the element with its sibling at this distance. */
export function moved(text: string, node: Node, by: 1 | -1): string {
  const sisters = node.parent?.children ?? [];
  const other = sisters[sisters.indexOf(node) + by];
  if (!other) return text;
  const [a, b] = by > 0 ? [node, other] : [other, node];
  return text.slice(0, a.start) + text.slice(b.start, b.end) + text.slice(a.end, b.start) + text.slice(a.start, a.end) + text.slice(b.end);
}

/** Renames a state and all references to it. */
export function with_state_renamed(text: string, root: Node, from: string, to: string): string {
  const places: { node: Node; attribute: string }[] = [];
  for (const node of nodes_in(root)) {
    if ((node.name === 'state' || node.name === 'end') && node.element.attribute('name')?.trim() === from)
      places.push({ node, attribute: 'name' });
    if (node.element.attribute('to')?.trim() === from) places.push({ node, attribute: 'to' });
    if (node === root && node.element.attribute('start')?.trim() === from) places.push({ node, attribute: 'start' });
  }
  return places.reverse().reduce((changed, { node, attribute }) => with_attribute(changed, node, attribute, to), text);
}
