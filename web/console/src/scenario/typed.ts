// Converts texts to typed command arguments by the component's profile, and validates them.
import type { Parameter, ParameterProfile } from 'rois-client';

import { data_type, is_packed, problem_of } from '../forms/data_type';
import type { ComponentView } from '../state/engine/profile_state';
import * as texts from './texts';
import { Trouble } from './trouble';

/** The arguments of a command: its own and the component's parameters. */
export function known_arguments(component: ComponentView, command_type: string): ParameterProfile[] {
  const own = component.commands.find((one) => one.name.toLowerCase() === command_type.toLowerCase())?.arguments ?? [];
  return [...own, ...component.parameters];
}

/** Repeated names make a list. Throws Trouble. */
export function typed_arguments(
  component: ComponentView,
  command_type: string,
  given: readonly { name: string; text: string }[],
): Parameter[] {
  const known = known_arguments(component, command_type);
  const parameters: Parameter[] = [];
  for (const { name, text } of given) {
    const declared = known.find((one) => one.name.toLowerCase() === name.toLowerCase());
    if (!declared) return Trouble.raise(() => texts.no_argument(component.ref, name, known.map((one) => one.name)));
    let argument = parameters.find((one) => one.name === declared.name);
    if (!argument) {
      argument = { name: declared.name, data_type_ref: declared.data_type_ref, values: [] };
      parameters.push(argument);
    }
    add_value(argument, text);
  }
  for (const { name, data_type_ref, values } of parameters) {
    const type = data_type(data_type_ref.code);
    const items = type.is_list && is_packed(type) ? values.join(' ').split(/\s+/).filter(Boolean) : values;
    if (!type.is_list && values.length !== 1) Trouble.raise(() => texts.one_value(name, type.name, values.length));
    const wrong = items.find((one) => problem_of(type, one) !== undefined);
    if (wrong !== undefined) Trouble.raise(() => texts.not_of_type(name, wrong, type.name));
  }
  return parameters;
}

// Lists of numbers and bools are one text. In other lists, an empty text is not an item.
function add_value(argument: Parameter, text: string): void {
  const type = data_type(argument.data_type_ref.code);
  if (type.is_list && is_packed(type) && argument.values.length > 0) argument.values[0] += ` ${text}`;
  else if (!type.is_list || is_packed(type) || text !== '') argument.values.push(text);
}
