// Conversion between steps of the editor and units of the specification.
import { code_of, type CommandMessage, type CommandUnit, command, type Parameter } from 'rois-client';

import { inputs_of } from '../forms/inputs';
import { type CommandStep, type Lane, new_command, new_lane, new_parallel, new_wait, type Step } from './model';

/** The arguments of a step, typed by its component's profile. */
export type ArgumentsOf = (step: CommandStep) => Parameter[];

/** All units, in document order. */
export function units_of_lane(root: Lane, arguments_of: ArgumentsOf): CommandUnit[] {
  return root.steps.flatMap((step) => unit_of(step, arguments_of));
}

function unit_of(step: Step, arguments_of: ArgumentsOf): CommandUnit[] {
  if (step.kind === 'wait') return [{ kind: 'delay', delay_time: milliseconds(step.time) ?? 0 }];
  if (step.kind === 'command') return [message_of(step, arguments_of)];
  const branches = step.branches.filter((one) => one.steps.length > 0);
  if (branches.length === 0) return [];
  const delay = milliseconds(step.delay);
  const rest = delay === undefined ? {} : { delay_time: delay };
  // RoIS 2.0 branches contain only commands; other branches need the units of RoIS 1.0.
  const plain = branches.map((one) => messages_of(one, arguments_of));
  if (plain.every((one): one is CommandMessage[] => one !== undefined)) return [{ kind: 'concurrent', branches: plain, ...rest }];
  return [{ kind: 'parallel', units: branches.map((one) => one_unit(units_of_lane(one, arguments_of))), ...rest }];
}

function one_unit(units: CommandUnit[]): CommandUnit {
  const [first] = units;
  return units.length === 1 && first ? first : { kind: 'sequential', units };
}

// A branch as commands only: a wait becomes the delay of the next command. Undefined if not possible.
function messages_of(lane: Lane, arguments_of: ArgumentsOf): CommandMessage[] | undefined {
  const messages: CommandMessage[] = [];
  let waited = 0;
  for (const step of lane.steps) {
    if (step.kind === 'parallel') return undefined;
    if (step.kind === 'wait') waited += milliseconds(step.time) ?? 0;
    else {
      const message = message_of(step, arguments_of);
      const delay = waited + (message.delay_time ?? 0);
      messages.push(delay > 0 ? { ...message, delay_time: delay } : message);
      waited = 0;
    }
  }
  return waited > 0 || messages.length === 0 ? undefined : messages;
}

function message_of(step: CommandStep, arguments_of: ArgumentsOf): CommandMessage {
  const delay = milliseconds(step.delay);
  return {
    ...command(step.component, step.command_type),
    arguments: [...arguments_of(step), ...step.unknown],
    ...(delay !== undefined && { delay_time: delay }),
  };
}

/** A whole number of ms, 0 or more. */
export function milliseconds(text: string): number | undefined {
  return /^\s*\d{1,9}\s*$/.test(text) ? Number(text) : undefined;
}

/** The steps of units. `knows`: whether a command has an argument of this name. */
export function lane_of(units: readonly CommandUnit[], knows: (component: string, command_type: string, name: string) => boolean): Lane {
  const step_of = (unit: CommandUnit): Step[] => {
    const delay = unit.delay_time === undefined ? '' : String(unit.delay_time);
    switch (unit.kind) {
      case 'delay':
        return [new_wait(delay || '0')];
      case 'command': {
        const component = code_of(unit.component_ref);
        const is_known = ({ name }: Parameter) => knows(component, unit.command_type, name);
        const inputs = inputs_of(unit.arguments.filter(is_known));
        return [
          new_command({
            component,
            command_type: unit.command_type,
            inputs,
            unknown: unit.arguments.filter((one) => !is_known(one)),
            delay,
          }),
        ];
      }
      case 'concurrent':
        return [new_parallel(unit.branches.map((one) => new_lane(one.flatMap(step_of))), delay)];
      case 'parallel':
        return [
          new_parallel(
            unit.units.map((one) =>
              new_lane(one.kind === 'sequential' && one.delay_time === undefined ? one.units.flatMap(step_of) : step_of(one)),
            ),
            delay,
          ),
        ];
      case 'sequential':
        // Within steps, a nested sequential unit makes no difference.
        return [...(delay === '' || delay === '0' ? [] : [new_wait(delay)]), ...unit.units.flatMap(step_of)];
    }
  };
  return new_lane(units.flatMap(step_of));
}
