// What the descriptions of profiles tell a form: units, choices, and what must be given.
import type { MessageProfile, ParameterProfile } from 'rois-client';

import type { ComponentView } from '../state/profile_state';
import { data_type } from './data_type';

const names: Record<string, string> = { millimetre: 'mm', millimeter: 'mm', degree: '°', millisecond: 'ms', second: 's', percent: '%', metre: 'm', meter: 'm' };
const unit = '(?:mm|ms|(?:millimet(?:re|er)|met(?:re|er)|degree|millisecond|second|percent)s?)';
const mentioned = new RegExp(`\\bin (${unit}(?:(?:, | and )${unit})*)\\b`, 'g');

/** The units that a description names, in its order: `["mm", "°"]` of "Distance in millimetre and direction in degree." */
export function units_of(description = ''): string[] {
  return [...description.matchAll(mentioned)].flatMap(([, list]) => list!.split(/, | and /).map((one) => names[one.replace(/s$/, '')] ?? names[one] ?? one));
}

/** The values that a description names, as in "`time` or `distance`": none when there is but one. */
export function choices_of(description = ''): string[] {
  const quoted = [...description.matchAll(/`([^`\s]+)`/g)].map(([, name]) => name!);
  return quoted.length > 1 ? quoted : [];
}

/** `needed`: it must be given. `either`: it or the other one must. */
export type Need = { kind: 'optional' } | { kind: 'needed' } | { kind: 'either'; other: string };

/** A parameter as a form asks for it. */
export interface Asked extends ParameterProfile {
  need: Need;
}

/** What a command takes: `start` and `set_parameter` the component's parameters, and each command what its own profile says. */
export function asked_by(view: ComponentView, command_type: string): Asked[] {
  if (command_type === 'set_parameter') return view.parameters.map((one) => ({ ...one, need: { kind: 'optional' } }));
  const own = view.commands.find((one) => same(one.name, command_type))?.arguments ?? [];
  const asked = own.map((one): Asked => ({ ...one, need: { kind: one.default_value === undefined ? 'needed' : 'optional' } }));
  if (!same(command_type, 'start')) return asked;
  const further = view.parameters.filter((one) => !own.some(({ name }) => same(name, one.name)));
  return [...asked, ...further.map((one) => ({ ...one, need: need_of(one) }))];
}

/** All that can be asked of a component by `execute`. */
export function command_types(view: ComponentView): string[] {
  const names = view.commands.map((one) => one.name);
  return view.parameters.length > 0 ? [...names, 'set_parameter'] : names;
}

/** As its description says at its end; what has a default value is optional. */
export function need_of({ description = '', default_value }: ParameterProfile): Need {
  if (default_value !== undefined) return { kind: 'optional' };
  const other = /\bEither this or (\w+) is mandatory\b/i.exec(description)?.[1];
  if (other !== undefined) return { kind: 'either', other };
  return { kind: /\bMandatory\.?\s*$/i.test(description) ? 'needed' : 'optional' };
}

/** How many items a list has whose description names a unit for each: 2 of "Distance in millimetre and direction in degree"; 0: any number. */
export function fixed_length({ data_type_ref, description }: ParameterProfile): number {
  const type = data_type(data_type_ref.code);
  if (!type.is_list || type.kind === 'text') return 0; // of a text the units are those of its parts
  const units = units_of(description);
  return units.length > 1 ? units.length : 0;
}

/** A description without what the form says by itself, and without where the specification has it. */
export function shown_description(description = ''): string {
  return description.replace(/\s*\b(Optional|Mandatory|Either this or \w+ is mandatory)\.?\s*$/i, '').replace(/ \((?:table )?[\d.]+\)/g, '').replaceAll('`', '');
}

/** Whether its texts are positions, as a floor map can give them. */
export function is_position({ name, description = '', data_type_ref }: ParameterProfile): boolean {
  return data_type(data_type_ref.code).kind === 'text' && (/position/i.test(name) || /"x, y(, th)?"/.test(description));
}

export function same(a: string, b: string): boolean {
  return a.toLowerCase() === b.toLowerCase();
}

/** `start(speech_text, volume)`, for what is read aloud and for hovering. */
export function signature({ name, arguments: given, results }: MessageProfile): string {
  const list = given.length > 0 ? given : results;
  return `${name}(${list.map((one) => one.name).join(', ')})`;
}
