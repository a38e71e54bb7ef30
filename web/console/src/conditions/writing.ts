// Writes a condition as Filter Encoding, and the request with it.
import {
  all_of,
  any_of,
  box,
  Condition,
  distance,
  element,
  everything,
  type Geometry,
  not,
  point,
  property,
  request,
  text_element,
} from 'rois-client';

import { is_number, problems_of } from './checking';
import type { Area, Draft, Node, Predicate, SortKey } from './model';
import { type Reference, resolved } from './vocabulary';

/** The complete parts of a draft. */
export function condition_of({ root, order, purpose }: Draft, references: readonly Reference[]): Condition {
  const filter = written(root, references) ?? everything;
  return purpose === 'subscribe' ? filter : order.filter((key) => sort_is_complete(key)).reduce(sorted, filter);
}

/** The request of the draft. */
export function request_of(draft: Draft, condition: Condition): string {
  const inside = condition.xml === '' ? '' : element('condition', {}, condition.xml);
  switch (draft.purpose) {
    case 'subscribe':
      return request('subscribe', { inline_results: draft.inline_results }, text_element('event_type', draft.event_type) + inside);
    case 'query':
      return request('query', {}, text_element('query_type', draft.query_type) + inside);
    default:
      return request(draft.purpose, {}, inside);
  }
}

/** A node as a condition; undefined if nothing in it is complete. */
export function written(node: Node, references: readonly Reference[]): Condition | undefined {
  const positive = written_plainly(node, references);
  return positive && node.is_not ? not(positive) : positive;
}

function written_plainly(node: Node, references: readonly Reference[]): Condition | undefined {
  if (node.kind === 'group') {
    const members = node.members.map((one) => written(one, references)).filter((one): one is Condition => one !== undefined);
    if (members.length === 0) return undefined;
    return node.joined === 'And' ? all_of(...members) : any_of(...members);
  }
  if (problems_of(node, references).length > 0) return undefined;
  return node.kind === 'written' ? new Condition(node.xml) : predicate_of(node, references);
}

const comparisons = {
  EqualTo: 'equals',
  NotEqualTo: 'differs_from',
  LessThan: 'less_than',
  GreaterThan: 'greater_than',
  LessThanOrEqualTo: 'at_most',
  GreaterThanOrEqualTo: 'at_least',
} as const;
const relations = { Within: 'within', Intersects: 'intersects', Disjoint: 'disjoint_from' } as const;

function predicate_of(one: Predicate, references: readonly Reference[]): Condition {
  const subject = property(one.reference.trim());
  const has_several = one.matching !== 'Any' && resolved(one.reference, references)?.is_list;
  const options = { ...(has_several && { match_action: one.matching }), ...(!one.match_case && { match_case: false }) };
  switch (one.operator) {
    case 'Between':
      return subject.between(one.value.trim(), one.upper.trim());
    case 'Like':
      return subject.like(one.value, one.match_case ? {} : { match_case: false });
    case 'Null':
      return subject.is_null();
    case 'Within':
    case 'Intersects':
    case 'Disjoint':
      return subject[relations[one.operator]](area_of(one.area));
    case 'DWithin':
      return subject.no_farther_than(Number(one.distance), area_of(one.area));
    case 'Beyond':
      return subject.farther_than(Number(one.distance), area_of(one.area));
    case 'After':
      return subject.after(new Date(one.value));
    case 'Before':
      return subject.before(new Date(one.value));
    case 'During':
      return subject.during(new Date(one.value), new Date(one.upper));
    default:
      return subject[comparisons[one.operator]](one.value.trim(), options);
  }
}

/** A name or a geometry. The corners of a box are sorted. */
function area_of({ kind, place, x, y, x2, y2, crs }: Area): string | Geometry {
  const frame = crs === '' ? undefined : crs;
  if (kind === 'place') return place.trim();
  if (kind === 'point') return point(Number(x), Number(y), frame);
  const [xs, ys] = [[Number(x), Number(x2)], [Number(y), Number(y2)]] as const;
  return box({ x: Math.min(...xs), y: Math.min(...ys) }, { x: Math.max(...xs), y: Math.max(...ys) }, frame);
}

function sort_is_complete({ by, reference, area }: SortKey): boolean {
  if (reference.trim() === '') return false;
  return by === 'value' || (area.kind === 'place' ? area.place.trim() !== '' : is_number(area.x) && is_number(area.y));
}

function sorted(condition: Condition, { by, reference, area, order }: SortKey): Condition {
  return condition.sorted_by(by === 'value' ? reference.trim() : distance(reference.trim(), area_of(area)), order);
}
