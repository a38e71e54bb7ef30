// The commands of `execute` (7.4.3.1, tables 10 to 15), in sequence and in parallel.
import { type Arguments, type Parameter, parameters_of, type Ref } from './values.js';

/** One command (table 12). */
export interface CommandMessage {
  kind: 'command';
  component_ref: Ref;
  command_type: string; // start, stop, suspend, resume, set_parameter, or a command of the component's profile
  command_id: string; // empty: the client assigns one
  arguments: Parameter[];
  delay_time?: number; // ms to wait before the command starts
}

/** Branches that run in parallel; the commands of a branch run one after the other. */
export interface ConcurrentCommands {
  kind: 'concurrent';
  branches: CommandMessage[][];
  delay_time?: number;
}

/** Units of RoIS 1.0, which nest freely. */
export interface SequentialCommandUnit {
  kind: 'sequential';
  units: CommandUnit[];
  delay_time?: number;
}
export interface ParallelCommandUnit {
  kind: 'parallel';
  units: CommandUnit[];
  delay_time?: number;
}

/** Only a delay. */
export interface DelayOnly {
  kind: 'delay';
  delay_time: number;
}

export type CommandUnit = CommandMessage | ConcurrentCommands | SequentialCommandUnit | ParallelCommandUnit | DelayOnly;

export interface CommandOptions {
  command_id?: string;
  delay_time?: number; // ms
}

export function command(component_ref: Ref, command_type: string, named: Arguments = {}, options: CommandOptions = {}): CommandMessage {
  const made: CommandMessage = {
    kind: 'command',
    component_ref,
    command_type,
    command_id: options.command_id ?? '',
    arguments: parameters_of(named),
  };
  if (options.delay_time !== undefined) made.delay_time = options.delay_time;
  return made;
}

export function concurrently(...branches: (CommandMessage | CommandMessage[])[]): ConcurrentCommands {
  return { kind: 'concurrent', branches: branches.map((one) => (Array.isArray(one) ? one : [one])) };
}

export function sequentially(...units: CommandUnit[]): SequentialCommandUnit {
  return { kind: 'sequential', units };
}

export function in_parallel(...units: CommandUnit[]): ParallelCommandUnit {
  return { kind: 'parallel', units };
}

export function delay(milliseconds: number): DelayOnly {
  return { kind: 'delay', delay_time: milliseconds };
}

/** All commands of the units, in document order. */
export function commands_of(units: readonly CommandUnit[]): CommandMessage[] {
  return units.flatMap((unit) => {
    if (unit.kind === 'command') return [unit];
    if (unit.kind === 'concurrent') return unit.branches.flat();
    return unit.kind === 'delay' ? [] : commands_of(unit.units);
  });
}

/** A copy of the units in which each unnamed command has a name. */
export function named<Unit extends CommandUnit>(units: readonly Unit[], next_id: () => string): Unit[] {
  return units.map((unit) => {
    if (unit.kind === 'command') return unit.command_id === '' ? { ...unit, command_id: next_id() } : unit;
    if (unit.kind === 'concurrent') return { ...unit, branches: unit.branches.map((branch) => named(branch, next_id)) };
    return unit.kind === 'delay' ? unit : { ...unit, units: named(unit.units, next_id) };
  });
}
