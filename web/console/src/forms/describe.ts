// Reads units, choices and mandatory parameters from the descriptions in profiles.
import type { MessageProfile, ParameterProfile } from 'rois-client';

import type { ComponentView } from '../state/engine/profile_state';
import { data_type } from './data_type';

const names: Record<string, string> = {
  millimetre: 'mm',
  millimeter: 'mm',
  degree: '°',
  millisecond: 'ms',
  second: 's',
  percent: '%',
  metre: 'm',
  meter: 'm',
};
const unit = '(?:mm|ms|(?:millimet(?:re|er)|met(?:re|er)|degree|millisecond|second|percent)s?)';
const mentioned = new RegExp(`\\bin (${unit}(?:(?:, | and )${unit})*)\\b`, 'g');

/** The units that a description names, in order: `["mm", "°"]` for "Distance in millimetre and direction in degree." */
export function units_of(description = ''): string[] {
  return [...description.matchAll(mentioned)].flatMap(([, list]) =>
    list!.split(/, | and /).map((one) => names[one.replace(/s$/, '')] ?? names[one] ?? one),
  );
}

/** The values that a description names, as in "`time` or `distance`"; none if it names only one. */
export function choices_of(description = ''): string[] {
  const quoted = [...description.matchAll(/`([^`\s]+)`/g)].map(([, name]) => name!);
  return quoted.length > 1 ? quoted : [];
}

/** `needed`: mandatory. `either`: this or `other` is mandatory. */
export type Need = { kind: 'optional' } | { kind: 'needed' } | { kind: 'either'; other: string };

/** A parameter with its need. */
export interface Asked extends ParameterProfile {
  need: Need;
}

/** The arguments of a command. `start` and `set_parameter` also take the component's parameters. */
export function asked_by(view: ComponentView, command_type: string): Asked[] {
  if (command_type === 'set_parameter') return view.parameters.map((one) => ({ ...one, need: { kind: 'optional' } }));
  const own = view.commands.find((one) => same(one.name, command_type))?.arguments ?? [];
  const asked = own.map((one): Asked => ({ ...one, need: { kind: one.default_value === undefined ? 'needed' : 'optional' } }));
  if (!same(command_type, 'start')) return asked;
  const further = view.parameters.filter((one) => !own.some(({ name }) => same(name, one.name)));
  return [...asked, ...further.map((one) => ({ ...one, need: need_of(one) }))];
}

/** All commands that `execute` accepts for a component. */
export function command_types(view: ComponentView): string[] {
  const names = view.commands.map((one) => one.name);
  return view.parameters.length > 0 ? [...names, 'set_parameter'] : names;
}

/** Read from the end of the description. A parameter with a default is optional. */
export function need_of({ description = '', default_value }: ParameterProfile): Need {
  if (default_value !== undefined) return { kind: 'optional' };
  const other = /\bEither this or (\w+) is mandatory\b/i.exec(description)?.[1];
  if (other !== undefined) return { kind: 'either', other };
  return { kind: /\bMandatory\.?\s*$/i.test(description) ? 'needed' : 'optional' };
}

/** The length of a list whose description names a unit for each item: 2 for "Distance in millimetre and direction in degree"; 0: any. */
export function fixed_length({ data_type_ref, description }: ParameterProfile): number {
  const type = data_type(data_type_ref.code);
  if (!type.is_list || type.kind === 'text') return 0; // the units of a text are those of its parts
  const units = units_of(description);
  return units.length > 1 ? units.length : 0;
}

/** The description without the need (shown by the form) and without references to the specification. */
export function shown_description(description = ''): string {
  return description
    .replace(/\s*\b(Optional|Mandatory|Either this or \w+ is mandatory)\.?\s*$/i, '')
    .replace(/ \((?:table )?[\d.]+\)/g, '')
    .replaceAll('`', '');
}

/** Whether its texts are positions that can be chosen on the map. */
export function is_position({ name, description = '', data_type_ref }: ParameterProfile): boolean {
  return data_type(data_type_ref.code).kind === 'text' && (/position/i.test(name) || /"x, y(, th)?"/.test(description));
}

export function same(a: string, b: string): boolean {
  return a.toLowerCase() === b.toLowerCase();
}

/** `start(speech_text, volume)`, for tooltips and screen readers. */
export function signature({ name, arguments: given, results }: MessageProfile): string {
  const list = given.length > 0 ? given : results;
  return `${name}(${list.map((one) => one.name).join(', ')})`;
}
