// Validates a sequence, step by step.
import type { Problem as FieldProblem } from '../forms/data_type';
import { asked_by, command_types, same } from '../forms/describe';
import { given, type Inputs, problems_of as field_problems } from '../forms/inputs';
import type { ComponentView } from '../state/engine/profile_state';
import { type CommandStep, commands_in, type Lane, type Step, steps_of } from './model';
import { milliseconds } from './units';

export interface Problem {
  step: number; // its id; 0: the sequence as a whole
  what:
    | 'nothing'
    | 'no_component'
    | 'unknown_component'
    | 'no_command'
    | 'unknown_command'
    | 'arguments'
    | 'unknown_arguments'
    | 'no_time'
    | 'no_branches';
  /** For `arguments`: by name. */
  fields?: Readonly<Record<string, FieldProblem>>;
}

export interface Profiles {
  component(ref: string): ComponentView | undefined;
  /** Whether a component already has a value for a parameter. */
  has_value(ref: string, name: string): boolean;
}

export function problems_in_sequence(root: Lane, profiles: Profiles): Problem[] {
  if (commands_in(root).length === 0 && root.steps.every((one) => one.kind !== 'wait')) return [{ step: 0, what: 'nothing' }];
  const set = new Set<string>(); // values set by earlier commands: `component parameter`
  return steps_of(root).flatMap((step) => problems_of_step(step, profiles, set));
}

function problems_of_step(step: Step, profiles: Profiles, set: Set<string>): Problem[] {
  const problem = (what: Problem['what']): Problem[] => [{ step: step.id, what }];
  switch (step.kind) {
    case 'wait':
      return milliseconds(step.time) === undefined ? problem('no_time') : [];
    case 'parallel':
      if (step.branches.every((one) => one.steps.length === 0)) return problem('no_branches');
      return delay_is_wrong(step.delay) ? problem('no_time') : [];
    case 'command':
      return problems_of_command(step, profiles, set);
  }
}

function problems_of_command(step: CommandStep, profiles: Profiles, set: Set<string>): Problem[] {
  const problem = (what: Problem['what']): Problem[] => [{ step: step.id, what }];
  if (step.component === '') return problem('no_component');
  const view = profiles.component(step.component);
  if (!view) return problem('unknown_component');
  if (step.command_type === '') return problem('no_command');
  if (!command_types(view).some((one) => same(one, step.command_type))) return problem('unknown_command');
  if (delay_is_wrong(step.delay)) return problem('no_time');
  if (step.unknown.length > 0) return problem('unknown_arguments');
  const asked = asked_by(view, step.command_type);
  const has_value = (name: string) => set.has(key(step, name)) || profiles.has_value(step.component, name);
  const fields = field_problems(asked, step.inputs, has_value);
  for (const one of asked) if (given(one, step.inputs as Inputs) !== undefined) set.add(key(step, one.name));
  return Object.keys(fields).length > 0 ? [{ step: step.id, what: 'arguments', fields }] : [];
}

function key({ component }: CommandStep, name: string): string {
  return `${component} ${name.toLowerCase()}`;
}

function delay_is_wrong(delay: string): boolean {
  return delay.trim() !== '' && milliseconds(delay) === undefined;
}

/** Whether the step is incomplete rather than wrong. */
export function is_unfinished({ what, fields }: Problem): boolean {
  if (what === 'arguments') return Object.values(fields ?? {}).every((one) => one.what === 'missing' || one.what === 'either');
  return what === 'nothing' || what === 'no_component' || what === 'no_command' || what === 'no_branches';
}
