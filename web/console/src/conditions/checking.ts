// Validates a condition before it is sent. Unknown references are left to the engine.
import { parse_xml } from 'rois-client';

import { unwritable } from '../forms/data_type';
import type { Area, Draft, Node, Predicate } from './model';
import { has_distance, has_two_values, is_spatial, is_temporal, type Reference, resolved } from './vocabulary';
import { wrapped } from './xml_writing';

export type ProblemField = 'reference' | 'value' | 'upper' | 'area' | 'distance' | 'xml';
export type Problem =
  | 'no_reference'
  | 'no_value'
  | 'no_number'
  | 'no_time'
  | 'no_place'
  | 'no_box'
  | 'no_point'
  | 'no_distance'
  | 'reversed'
  | 'no_xml'
  | 'unwritable';

const wrong: readonly Problem[] = ['no_number', 'reversed', 'no_xml', 'unwritable'];

export interface Found {
  field: ProblemField;
  problem: Problem;
  /** Missing rather than wrong. */
  is_missing: boolean;
}

export function problems_of(node: Node, references: readonly Reference[]): Found[] {
  if (node.kind === 'group') return node.members.flatMap((one) => problems_of(one, references));
  if (node.kind === 'written') return is_xml(node.xml) ? [] : [{ field: 'xml', problem: 'no_xml', is_missing: false }];
  const found: Found[] = [];
  const add = (field: ProblemField, problem: Problem | undefined) =>
    problem && found.push({ field, problem, is_missing: !wrong.includes(problem) });
  if (node.reference.trim() === '') add('reference', 'no_reference');
  if (node.operator === 'Null') return found;
  if (is_spatial(node.operator)) {
    add('area', area_problem(node.area));
    if (has_distance(node.operator) && !(is_number(node.distance) && Number(node.distance) >= 0)) add('distance', 'no_distance');
    return found;
  }
  add('value', value_problem(node, node.value, references));
  if (has_two_values(node.operator))
    add('upper', value_problem(node, node.upper, references) ?? (is_reversed(node) ? 'reversed' : undefined));
  return found;
}

/** Whether the draft can be sent. */
export function is_complete({ root, purpose, event_type, query_type }: Draft, references: readonly Reference[]): boolean {
  if (purpose === 'subscribe' && event_type === '') return false;
  if (purpose === 'query' && query_type === '') return false;
  return problems_of(root, references).length === 0;
}

function value_problem({ operator, reference }: Predicate, value: string, references: readonly Reference[]): Problem | undefined {
  if (is_temporal(operator)) return is_time(value) ? undefined : 'no_time';
  if (value.trim() === '') return 'no_value';
  if (unwritable.test(value)) return 'unwritable';
  if (operator !== 'Like' && resolved(reference, references)?.type === 'number' && !is_number(value)) return 'no_number';
  return undefined;
}

function is_reversed({ operator, value, upper }: Predicate): boolean {
  if (operator === 'During') return is_time(value) && is_time(upper) && new Date(value) >= new Date(upper);
  return is_number(value) && is_number(upper) && Number(value) > Number(upper);
}

export function area_problem({ kind, place, x, y, x2, y2 }: Area): Problem | undefined {
  if (kind === 'place') return place.trim() === '' ? 'no_place' : unwritable.test(place) ? 'unwritable' : undefined;
  const numbers = kind === 'box' ? [x, y, x2, y2] : [x, y];
  return numbers.every(is_number) ? undefined : kind === 'box' ? 'no_box' : 'no_point';
}

export function is_number(text: string): boolean {
  return text.trim() !== '' && Number.isFinite(Number(text));
}

function is_time(text: string): boolean {
  return text.trim() !== '' && !Number.isNaN(new Date(text).getTime());
}

// One element, with the prefixes that requests declare.
function is_xml(text: string): boolean {
  try {
    return parse_xml(wrapped(text)).children.length === 1;
  } catch {
    return false;
  }
}
