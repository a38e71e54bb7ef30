// References of conditions (docs/conditions.md): common properties, parameters and results of the profiles.
import type { ParameterProfile } from 'rois-client';

import { all_values, data_type, type DataType } from '../forms/data_type';
import { is_position, units_of } from '../forms/describe';
import { options_for, type World } from '../forms/options';
import type { ComponentView } from '../state/engine/profile_state';
import type { Draft, Operator } from './model';

export type ValueType = 'text' | 'number' | 'bool' | 'time' | 'position';

export interface Reference {
  path: string;
  type: ValueType;
  /** Whether it may have several values. */
  is_list: boolean;
  of: 'component' | 'parameter' | 'result';
  description: string;
  unit: string; // empty: none
  /** Known values. */
  options: readonly string[];
  /** Whether other values are invalid. */
  is_closed: boolean;
}

/** The components, things and places that references and values come from. */
export interface Known extends Omit<World, 'components' | 'parameters'> {
  components: readonly ComponentView[];
  engines: readonly string[];
}

const statuses = all_values(data_type('Component_Status')) ?? [];
const words = ['component_ref', 'component_type', 'name', 'identifier', 'engine', 'robotid', 'status', 'bound', 'location', 'located'];

/** All references for this purpose. */
export function references_of(known: Known, { purpose, event_type, query_type }: Draft): Reference[] {
  const word = (path: string, options: readonly string[], more: Partial<Reference> = {}): Reference => ({
    path, type: 'text', is_list: false, of: 'component', description: '', unit: '', options, is_closed: true, ...more,
  });
  const { components } = known;
  const results =
    purpose === 'subscribe'
      ? results_of(components, 'events', event_type)
      : purpose === 'query'
        ? results_of(components, 'queries', query_type)
        : [];
  const of_results = results.map((one) =>
    typed(words.includes(one.name.toLowerCase()) ? `Result/${one.name}` : one.name, one, 'result', known),
  );
  if (of_results.some((one) => one.type === 'position'))
    of_results.push(word('located', [], { type: 'position', is_list: true, of: 'result' }));
  return [
    ...of_results,
    word('component_ref', components.map((one) => one.ref)),
    word('component_type', unique(components.flatMap((one) => [one.type, ...one.includes])).sort()),
    word('status', statuses),
    word('bound', ['true', 'false'], { type: 'bool' }),
    word('location', known.places, { type: 'position' }),
    word('engine', known.engines),
    word('RobotId', unique([...[...known.robots].map((one) => one.ref), ...known.engines]), { is_closed: false }),
    ...parameters_of(components).map((one) => typed(`Property/${one.name}`, one, 'parameter', known)),
  ];
}

/** Whether a path refers to a result, which only events and answers have. */
export function is_of_results(path: string, references: readonly Reference[]): boolean {
  const name = first_step(path);
  return name === 'result' || name === 'timestamp' || resolved(path, references)?.of === 'result';
}

/** The reference of a path; undefined if unknown. Names are case-insensitive. */
export function resolved(path: string, references: readonly Reference[]): Reference | undefined {
  const plain = path.trim().toLowerCase().replace(/\w+:/g, '').replace(/\[[^\]]*\]/g, '');
  const whole = plain === 'name' || plain === 'identifier' ? 'component_ref' : plain;
  const by_path = (wanted: string) => references.find((one) => one.path.toLowerCase() === wanted);
  const found = by_path(whole) ?? by_path(`property/${whole}`) ?? by_path(whole.replace(/^(result|property)\//, ''));
  if (found || !whole.includes('/@')) return found;
  const owner = by_path(whole.slice(0, whole.indexOf('/@')));
  return owner && { ...owner, path, type: 'text', options: [], is_closed: false };
}

function first_step(path: string): string {
  return path.trim().toLowerCase().replace(/^\w+:/, '').split('/')[0] ?? '';
}

// The results of all messages of this name; the first result of a name counts.
function results_of(components: readonly ComponentView[], kind: 'events' | 'queries', name: string): ParameterProfile[] {
  return unique_names(
    components.flatMap((one) => one[kind].filter((message) => message.name === name).flatMap((message) => message.results)),
  );
}

function parameters_of(components: readonly ComponentView[]): ParameterProfile[] {
  const readable = (one: ComponentView) =>
    (one.profile?.messages ?? [])
      .filter((message) => message.kind === 'query' && message.name === 'get_parameter')
      .flatMap((message) => message.results);
  return unique_names(components.flatMap((one) => [...one.parameters, ...readable(one)])).sort((a, b) =>
    a.name.localeCompare(b.name, 'en'),
  );
}

function typed(path: string, profile: ParameterProfile, of: Reference['of'], known: Known): Reference {
  const of_type = data_type(profile.data_type_ref.code);
  const type = type_of(of_type, profile);
  const { list, is_closed } = options_for(
    { ...profile, need: { kind: 'optional' } },
    { ...known, components: known.components.map((one) => one.ref), parameters: undefined },
  );
  const options = list.map((one) => one.value);
  const unit = type === 'number' ? (units_of(profile.description)[0] ?? '') : '';
  return { path, type, is_list: of_type.is_list, of, description: profile.description ?? '', unit, options, is_closed };
}

function type_of({ kind }: DataType, profile: ParameterProfile): ValueType {
  if (kind === 'integer' || kind === 'number') return 'number';
  if (kind === 'bool') return 'bool';
  if (kind === 'date_time') return 'time';
  return is_position(profile) || (kind === 'text' && /^target$/.test(profile.name)) ? 'position' : 'text';
}

function unique(list: readonly string[]): string[] {
  return [...new Set(list)];
}

function unique_names(list: readonly ParameterProfile[]): ParameterProfile[] {
  const seen = new Set<string>();
  return list.filter(({ name }) => !seen.has(name.toLowerCase()) && seen.add(name.toLowerCase()));
}

// --- Operators by type ---

const equality: Operator[] = ['EqualTo', 'NotEqualTo'];
const order: Operator[] = ['LessThan', 'LessThanOrEqualTo', 'GreaterThan', 'GreaterThanOrEqualTo', 'Between'];

export function operators_for(type: ValueType): readonly Operator[] {
  switch (type) {
    case 'number':
      return [...equality, ...order, 'Null'];
    case 'bool':
      return [...equality, 'Null'];
    case 'time':
      return ['After', 'Before', 'During', 'Null'];
    case 'position':
      return ['Within', 'DWithin', 'Disjoint', 'Beyond', 'Null'];
    case 'text':
      return [...equality, 'Like', 'Null'];
  }
}

export function is_spatial(operator: Operator): boolean {
  return ['Within', 'Intersects', 'Disjoint', 'DWithin', 'Beyond'].includes(operator);
}
export function is_temporal(operator: Operator): boolean {
  return ['After', 'Before', 'During'].includes(operator);
}
export function has_distance(operator: Operator): boolean {
  return operator === 'DWithin' || operator === 'Beyond';
}
export function has_two_values(operator: Operator): boolean {
  return operator === 'Between' || operator === 'During';
}
