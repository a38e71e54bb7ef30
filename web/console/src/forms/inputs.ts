// The contents of a form, their problems, and the parameters made from them.
import type { Parameter } from 'rois-client';

import { data_type, is_packed, type Problem, problem_of } from './data_type';
import { type Asked, fixed_length, same } from './describe';

/** The input of one field: a text, or the items of a list. Blank texts are ignored. */
export interface Input {
  texts: readonly string[];
  /** Send an empty text or list instead of omitting the parameter. */
  is_empty?: boolean;
}

/** By parameter name; missing parameters are omitted. */
export type Inputs = Readonly<Record<string, Input>>;

/** A choice. */
export interface Option {
  value: string;
  label?: string;
  codebook?: string; // of an identifier
}

/** The entered items; undefined if the parameter is omitted. */
export function given(asked: Asked, inputs: Inputs): string[] | undefined {
  const input = inputs[asked.name];
  const texts = (input?.texts ?? []).filter((text) => text.trim() !== '');
  if (texts.length > 0) return data_type(asked.data_type_ref.code).is_list ? [...texts] : texts.slice(0, 1);
  return input?.is_empty ? [] : undefined;
}

/** Problems by parameter name. `has_value`: whether the component already has a value, from an earlier set_parameter. */
export function problems_of(
  all: readonly Asked[],
  inputs: Inputs,
  has_value: (name: string) => boolean = () => false,
): Record<string, Problem> {
  const problems: Record<string, Problem> = {};
  for (const asked of all) {
    const items = given(asked, inputs);
    const problem = items === undefined ? missing(asked, all, inputs, has_value) : wrong_in(asked, items);
    if (problem) problems[asked.name] = problem;
  }
  return problems;
}

function wrong_in(asked: Asked, items: string[]): Problem | undefined {
  const length = fixed_length(asked);
  if (length > 0 && items.length > 0 && items.length !== length) return { what: 'missing' };
  const type = data_type(asked.data_type_ref.code);
  return items.map((item) => problem_of(type, item)).find((one) => one !== undefined);
}

function missing({ name, need }: Asked, all: readonly Asked[], inputs: Inputs, has_value: (name: string) => boolean): Problem | undefined {
  if (need.kind === 'optional' || has_value(name)) return undefined;
  if (need.kind === 'needed') return { what: 'missing' };
  const other = all.find((one) => same(one.name, need.other));
  const is_there = has_value(need.other) || (other !== undefined && given(other, inputs) !== undefined);
  return is_there ? undefined : { what: 'either', other: need.other };
}

/** The parameters of the message, in the profile's order. `codebook` returns the codebook of an identifier. */
export function parameters_from(
  all: readonly Asked[],
  inputs: Inputs,
  codebook: (name: string, code: string) => string | undefined = () => undefined,
): Parameter[] {
  return all.flatMap((asked): Parameter[] => {
    const items = given(asked, inputs);
    if (items === undefined) return [];
    const type = data_type(asked.data_type_ref.code);
    const trimmed = type.kind === 'text' ? items : items.map((item) => item.trim());
    const codebooks = type.kind === 'identifier' ? trimmed.map((code) => codebook(asked.name, code)) : [];
    const one = codebooks.length > 0 && codebooks.every((each) => each === codebooks[0]) ? codebooks[0] : undefined;
    const data_type_ref = one === undefined ? asked.data_type_ref : { ...asked.data_type_ref, codebook_ref: one };
    return [{ name: asked.name, data_type_ref, values: values_of(trimmed, type.is_list, is_packed(type)) }];
  });
}

function values_of(items: string[], is_list: boolean, packed: boolean): string[] {
  if (!is_list) return [items[0] ?? ''];
  return packed ? [items.join(' ')] : items;
}

/** The inputs that would produce these parameters. */
export function inputs_of(parameters: readonly Parameter[]): Inputs {
  return Object.fromEntries(
    parameters.map(({ name, data_type_ref, values }): [string, Input] => {
      const type = data_type(data_type_ref.code);
      const texts = type.is_list && is_packed(type) ? values.join(' ').split(/\s+/).filter((text) => text !== '') : values;
      return [name, texts.every((text) => text === '') ? { texts: [], is_empty: true } : { texts }];
    }),
  );
}

/** A copy of the inputs with one changed. */
export function with_input(inputs: Inputs, name: string, input: Input | undefined): Inputs {
  const { [name]: _, ...others } = inputs;
  return input === undefined || (input.texts.every((text) => text === '') && !input.is_empty && input.texts.length < 2)
    ? others
    : { ...others, [name]: input };
}
