// Choices for a parameter: places, robots, persons, components, and values that the component itself offers.
import type { Results } from 'rois-client';

import type { Entity, Robot } from '../state/floor/things';
import { name_in } from './codebooks';
import { all_values, data_type } from './data_type';
import { type Asked, choices_of, is_position, same } from './describe';
import type { Option } from './inputs';

/** The known things of the world. */
export interface World {
  places: readonly string[];
  robots: Iterable<Robot>;
  entities: Iterable<Entity>;
  components: readonly string[];
  /** The component's own parameters (`get_parameter`). */
  parameters: Results | undefined;
}

/** Choices. Other texts may be typed unless `is_closed`. */
export interface Options {
  list: readonly Option[];
  is_closed: boolean;
}

export function options_for(asked: Asked, world: World): Options {
  const type = data_type(asked.data_type_ref.code);
  const closed = all_values(type) ?? choices_of(asked.description);
  if (closed.length > 0) return { list: closed.map((value) => ({ value })), is_closed: true };
  const able = offered_by(asked.name, world.parameters);
  if (able.length > 0) return { list: able, is_closed: false };
  if (is_position(asked)) return { list: world.places.map((value) => ({ value })), is_closed: false };
  if (type.kind === 'identifier' || /_ref$/i.test(asked.name)) return { list: things_for(asked.name, world), is_closed: false };
  return { list: [], is_closed: false };
}

// `language` is chosen from `synthesizable_languages`, `reaction_ref` from `available_reactions`.
function offered_by(name: string, parameters: Results | undefined): Option[] {
  const plural = name.replace(/_ref$/i, '').replace(/s$/, '') + 's';
  const list = parameters?.parameters.find((one) => !same(one.name, name) && one.name.toLowerCase().endsWith(`_${plural.toLowerCase()}`));
  const codebook = list?.data_type_ref.codebook_ref;
  return list && parameters ? parameters.texts(list.name).map((value) => option_of(value, codebook)) : [];
}

function option_of(value: string, codebook: string | undefined): Option {
  const label = name_in(codebook, value);
  return { value, ...(codebook !== undefined && { codebook }), ...(label !== undefined && { label }) };
}

function things_for(name: string, { robots, entities, components }: World): Option[] {
  if (/component/i.test(name)) return components.map((value) => ({ value }));
  const machines = [...robots].map(({ ref, codebook }): Option => ({ value: ref, codebook }));
  if (/robot/i.test(name)) return machines;
  const people: Option[] = [];
  const known: Option[] = [];
  const kind = /^(face|sound)/i.exec(name)?.[1]?.toLowerCase() ?? 'person';
  for (const { ref, codebook, identity, kind: entity_kind, is_seen } of entities) {
    if (entity_kind !== kind || !is_seen) continue;
    people.push({ value: ref, codebook, ...(identity && { label: `${ref} (${identity.ref})` }) });
    if (identity) known.push({ value: identity.ref, codebook: identity.codebook, label: `${identity.ref} (${ref})` });
  }
  if (/visitor/i.test(name)) return known;
  if (/person|face|sound/i.test(name)) return [...people, ...known];
  return /object|target|entity/i.test(name) ? [...people, ...known, ...machines] : [];
}
