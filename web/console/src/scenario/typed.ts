// Texts as arguments of a command, typed as the component's profile says; checked before anything is sent.
import type { Parameter, ParameterProfile } from 'rois-client';

import type { ComponentView } from '../state/profile_state';
import { Trouble } from './trouble';

/** What a command may be given: its own arguments, and whatever `set_parameter` takes. */
export function known_arguments(component: ComponentView, command_type: string): ParameterProfile[] {
  const own = component.commands.find((one) => one.name.toLowerCase() === command_type.toLowerCase())?.arguments ?? [];
  return [...own, ...component.parameters];
}

/** Several of one name are a list. Throws Trouble. */
export function typed_arguments(component: ComponentView, command_type: string, given: readonly { name: string; text: string }[]): Parameter[] {
  const known = known_arguments(component, command_type);
  const made: Parameter[] = [];
  for (const { name, text } of given) {
    const declared = known.find((one) => one.name.toLowerCase() === name.toLowerCase());
    if (!declared) return Trouble.raise((w) => w.no_argument(component.ref, name, known.map((one) => one.name)));
    let argument = made.find((one) => one.name === declared.name);
    if (!argument) made.push((argument = { name: declared.name, data_type_ref: declared.data_type_ref, values: [] }));
    add_value(argument, text);
  }
  for (const { name, data_type_ref, values } of made) {
    const { base, list } = type_of(data_type_ref.code);
    const items = list && base !== 'text' ? values.join(' ').split(/\s+/).filter(Boolean) : values;
    if (!list && values.length !== 1) Trouble.raise((w) => w.one_value(name));
    const wrong = items.find((one) => !is_of(base, one));
    if (wrong !== undefined) Trouble.raise((w) => w.not_of_type(name, wrong, data_type_ref.code));
  }
  return made;
}

type Base = 'integer' | 'real' | 'boolean' | 'text';

const bases: Record<string, Base> = {
  int: 'integer', integer: 'integer', unlimitednatural: 'integer', long: 'integer', short: 'integer', byte: 'integer', unsignedlong: 'integer', unsignedint: 'integer',
  unsignedshort: 'integer', unsignedbyte: 'integer', nonnegativeinteger: 'integer', positiveinteger: 'integer', nonpositiveinteger: 'integer', negativeinteger: 'integer',
  double: 'real', real: 'real', float: 'real', decimal: 'real', number: 'real',
  bool: 'boolean', boolean: 'boolean',
};

function type_of(code: string): { base: Base; list: boolean } {
  const item = /^(?:(.*)\[\]|(?:set|list|sequence|seq)\s*<(.*)>)$/i.exec(code.trim());
  const name = (item?.[1] ?? item?.[2] ?? code).trim();
  return { base: bases[name.slice(Math.max(name.lastIndexOf(':'), name.lastIndexOf('#'), name.lastIndexOf('/')) + 1).toLowerCase()] ?? 'text', list: item !== null };
}

function is_of(base: Base, value: string): boolean {
  const text = value.trim();
  if (base === 'integer') return /^[+-]?\d+$/.test(text);
  if (base === 'real') return /^[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?$|^[+-]?INF$|^NaN$/.test(text);
  return base === 'text' || /^(true|false|1|0)$/.test(text);
}

// Lists of numbers and truth values are one text; of other things, an empty text is no item.
function add_value(argument: Parameter, text: string): void {
  const { base, list } = type_of(argument.data_type_ref.code);
  if (list && base !== 'text' && argument.values.length > 0) argument.values[0] += ` ${text}`;
  else if (!list || base !== 'text' || text !== '') argument.values.push(text);
}
