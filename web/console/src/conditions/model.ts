// A condition being edited: groups of predicates. Values are texts as typed.

/** The operation that uses the condition. */
export type Purpose = 'search' | 'bind_any' | 'subscribe' | 'query';
export const purposes: readonly Purpose[] = ['search', 'bind_any', 'subscribe', 'query'];

/** How the members of a group are joined. */
export type Joining = 'all_of' | 'any_of' | 'none_of' | 'not_all_of';

export type Operator =
  | 'EqualTo' | 'NotEqualTo' | 'LessThan' | 'GreaterThan' | 'LessThanOrEqualTo' | 'GreaterThanOrEqualTo'
  | 'Between' | 'Like' | 'Null'
  | 'Within' | 'Intersects' | 'Disjoint' | 'DWithin' | 'Beyond'
  | 'After' | 'Before' | 'During';

export type AreaKind = 'place' | 'box' | 'point';

/** A place by name, a box by two corners, or a point; mm. */
export interface Area {
  kind: AreaKind;
  place: string;
  x: string;
  y: string;
  x2: string;
  y2: string;
  crs: string; // empty: the engine's
}

export interface Predicate {
  kind: 'predicate';
  id: number;
  is_not: boolean;
  reference: string;
  operator: Operator;
  value: string; // also the lower boundary and the begin of a period
  upper: string;
  area: Area;
  distance: string; // mm
  match_case: boolean;
  matching: 'Any' | 'All' | 'One';
}

/** A predicate without fields in this form; kept as XML. */
export interface Written {
  kind: 'written';
  id: number;
  is_not: boolean;
  xml: string; // with the prefixes fes, gml and rois
}

export interface Group {
  kind: 'group';
  id: number;
  is_not: boolean;
  joined: 'And' | 'Or';
  members: Node[];
}

export type Node = Group | Predicate | Written;

/** A sort key: a value, or a position's distance from an area. */
export interface SortKey {
  id: number;
  by: 'value' | 'distance';
  reference: string;
  area: Area;
  order: 'ASC' | 'DESC';
}

export interface Draft {
  purpose: Purpose;
  event_type: string;
  query_type: string;
  inline_results: boolean;
  root: Group;
  order: SortKey[];
}

let last_id = 0;
const next_id = () => (last_id += 1);

export function new_area(kind: AreaKind = 'place'): Area {
  return { kind, place: '', x: '', y: '', x2: '', y2: '', crs: '' };
}

export function new_predicate(given: Partial<Predicate> = {}): Predicate {
  return {
    kind: 'predicate', id: next_id(), is_not: false, reference: '', operator: 'EqualTo', value: '', upper: '',
    area: new_area(), distance: '', match_case: true, matching: 'Any', ...given,
  };
}

export function new_written(xml: string, is_not = false): Written {
  return { kind: 'written', id: next_id(), is_not, xml };
}

export function new_group(members: Node[] = [], joined: Group['joined'] = 'And', is_not = false): Group {
  return { kind: 'group', id: next_id(), is_not, joined, members };
}

export function new_sort_key(given: Partial<SortKey> = {}): SortKey {
  return { id: next_id(), by: 'value', reference: 'component_ref', area: new_area(), order: 'ASC', ...given };
}

export function new_draft(): Draft {
  return { purpose: 'search', event_type: '', query_type: '', inline_results: true, root: new_group(), order: [] };
}

/** A copy of the tree with one node changed. */
export function with_changed<T extends Node>(node: T, id: number, change: (node: Node) => Node): T {
  if (node.id === id) return change(node) as T;
  if (node.kind !== 'group') return node;
  return { ...node, members: node.members.map((one) => with_changed(one, id, change)) };
}

export function without(group: Group, id: number): Group {
  const members = group.members.filter((one) => one.id !== id);
  return { ...group, members: members.map((one) => (one.kind === 'group' ? without(one, id) : one)) };
}

export function with_added(root: Group, group: number, node: Node): Group {
  return with_changed(root, group, (one) => (one.kind === 'group' ? { ...one, members: [...one.members, node] } : one));
}

/** Wraps a node in a group. */
export function with_wrapped(root: Group, id: number): Group {
  return with_changed(root, id, (one) => new_group([one], 'Or'));
}

/** All predicates of a tree, in order. */
export function leaves_of(node: Node): (Predicate | Written)[] {
  return node.kind === 'group' ? node.members.flatMap(leaves_of) : [node];
}

// --- Storage across visits ---

export function draft_text(draft: Draft): string {
  return JSON.stringify(draft);
}

/** Undefined if invalid; ids are new. */
export function draft_of(text: string | undefined): Draft | undefined {
  try {
    const read = JSON.parse(text ?? '') as Draft;
    if (!purposes.includes(read.purpose) || read.root.kind !== 'group') return undefined;
    const order = read.order.map(({ id: _, ...one }) => new_sort_key(one));
    return { ...new_draft(), ...read, root: renewed(read.root) as Group, order };
  } catch {
    return undefined;
  }
}

function renewed(node: Node): Node {
  if (node.kind === 'group') return new_group(node.members.map(renewed), node.joined, node.is_not);
  if (node.kind === 'written') return new_written(node.xml, node.is_not);
  const { id: _, ...rest } = node;
  return new_predicate(rest);
}
