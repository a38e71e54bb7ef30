// A sequence being edited: steps in order, and parallel branches.
import type { Parameter } from 'rois-client';

import type { Inputs } from '../forms/inputs';

export interface CommandStep {
  kind: 'command';
  id: number;
  component: string; // its ref; empty: not chosen
  command_type: string;
  inputs: Inputs;
  /** Imported arguments that the profile does not have. */
  unknown: Parameter[];
  delay: string; // ms before it starts, as typed; empty: none
}

export interface WaitStep {
  kind: 'wait';
  id: number;
  time: string; // ms, as typed
}

export interface ParallelStep {
  kind: 'parallel';
  id: number;
  branches: Lane[];
  delay: string;
}

export type Step = CommandStep | WaitStep | ParallelStep;

/** Steps in order: the sequence itself or a branch. */
export interface Lane {
  id: number;
  steps: Step[];
}

/** A place in a lane: before the step of this index. */
export interface Slot {
  lane: number;
  index: number;
}

let last_id = 0;
const next_id = () => (last_id += 1);

export function new_command(given: Partial<Omit<CommandStep, 'kind' | 'id'>> = {}): CommandStep {
  return { kind: 'command', id: next_id(), component: '', command_type: '', inputs: {}, unknown: [], delay: '', ...given };
}

export function new_wait(time = '1000'): WaitStep {
  return { kind: 'wait', id: next_id(), time };
}

export function new_lane(steps: Step[] = []): Lane {
  return { id: next_id(), steps };
}

export function new_parallel(branches: Lane[] = [new_lane(), new_lane()], delay = ''): ParallelStep {
  return { kind: 'parallel', id: next_id(), branches, delay };
}

/** A copy with new ids. */
export function copy_of(step: Step): Step {
  if (step.kind === 'parallel') return new_parallel(step.branches.map((one) => new_lane(one.steps.map(copy_of))), step.delay);
  return { ...step, id: next_id() };
}

/** A step with its place. */
export interface Found {
  step: Step;
  slot: Slot;
  lane: Lane;
  /** The parallel step and branch number of the lane; undefined in the sequence itself. */
  parallel?: ParallelStep;
  branch: number;
}

export function found(root: Lane, id: number): Found | undefined {
  return find_in(root, id, undefined, 0);
}

function find_in(lane: Lane, id: number, parallel: ParallelStep | undefined, branch: number): Found | undefined {
  for (const [index, step] of lane.steps.entries()) {
    if (step.id === id) return { step, slot: { lane: lane.id, index }, lane, branch, ...(parallel && { parallel }) };
    if (step.kind !== 'parallel') continue;
    for (const [i, one] of step.branches.entries()) {
      const inner = find_in(one, id, step, i);
      if (inner) return inner;
    }
  }
  return undefined;
}

/** All steps in document order; a parallel step before its branches. */
export function steps_of(lane: Lane): Step[] {
  return lane.steps.flatMap((step) => [step, ...(step.kind === 'parallel' ? step.branches.flatMap(steps_of) : [])]);
}

export function commands_in(lane: Lane): CommandStep[] {
  return steps_of(lane).filter((one): one is CommandStep => one.kind === 'command');
}

// --- Edits. Each returns a new tree. ---

function mapped(lane: Lane, change: (steps: Step[], lane: Lane) => Step[]): Lane {
  const inside = lane.steps.map((step) =>
    step.kind === 'parallel' ? { ...step, branches: step.branches.map((one) => mapped(one, change)) } : step,
  );
  return { ...lane, steps: change(inside, lane) };
}

export function with_changed(root: Lane, id: number, change: (step: Step) => Step): Lane {
  return mapped(root, (steps) => steps.map((one) => (one.id === id ? change(one) : one)));
}

export function with_inserted(root: Lane, { lane, index }: Slot, ...inserted: Step[]): Lane {
  return mapped(root, (steps, of) => (of.id === lane ? [...steps.slice(0, index), ...inserted, ...steps.slice(index)] : steps));
}

export function without(root: Lane, id: number): Lane {
  return mapped(root, (steps) => steps.filter((one) => one.id !== id));
}

export function with_branch(root: Lane, parallel: number): Lane {
  return with_changed(root, parallel, (step) => (step.kind === 'parallel' ? { ...step, branches: [...step.branches, new_lane()] } : step));
}

/** Removes a branch with its steps. If only one branch remains, its steps replace the parallel step. */
export function without_branch(root: Lane, lane: number): Lane {
  return mapped(root, (steps) =>
    steps.flatMap((step) => {
      if (step.kind !== 'parallel' || !step.branches.some((one) => one.id === lane)) return [step];
      const branches = step.branches.filter((one) => one.id !== lane);
      return branches.length > 1 ? [{ ...step, branches }] : (branches[0]?.steps ?? []);
    }),
  );
}

/** Moves a step to the slot. Returns the same tree if it cannot go there. */
export function with_moved(root: Lane, id: number, to: Slot): Lane {
  const from = found(root, id);
  if (!from || (from.step.kind === 'parallel' && from.step.branches.some((one) => holds(one, to.lane)))) return root;
  const is_same_lane = from.slot.lane === to.lane;
  const index = is_same_lane && from.slot.index < to.index ? to.index - 1 : to.index;
  if (is_same_lane && index === from.slot.index) return root;
  return with_inserted(without(root, id), { lane: to.lane, index }, from.step);
}

function holds(lane: Lane, id: number): boolean {
  return lane.id === id || lane.steps.some((step) => step.kind === 'parallel' && step.branches.some((one) => holds(one, id)));
}

export type Direction = 'earlier' | 'later' | 'up' | 'down';

/**
 * The slot one step in a direction. Earlier and later: within its lane, and out of a branch at its ends. Up and down: to the neighbouring
 * branch, or into an adjacent parallel step. Undefined: none.
 */
export function slot_towards(root: Lane, id: number, direction: Direction): Slot | undefined {
  const at = found(root, id);
  if (!at) return undefined;
  const { lane, slot, parallel, branch } = at;
  const around = parallel && found(root, parallel.id)?.slot;
  switch (direction) {
    case 'earlier':
      return slot.index > 0 ? { lane: lane.id, index: slot.index - 1 } : around;
    case 'later':
      return slot.index < lane.steps.length - 1
        ? { lane: lane.id, index: slot.index + 2 }
        : around && { lane: around.lane, index: around.index + 1 };
    case 'up':
    case 'down': {
      const neighbour = lane.steps[slot.index + (direction === 'up' ? -1 : 1)];
      const beside = parallel?.branches[branch + (direction === 'up' ? -1 : 1)];
      if (beside) return { lane: beside.id, index: Math.min(slot.index, beside.steps.length) };
      if (neighbour?.kind !== 'parallel') return undefined;
      const into = direction === 'up' ? neighbour.branches.at(-1) : neighbour.branches[0];
      return into && { lane: into.id, index: direction === 'up' ? into.steps.length : 0 };
    }
  }
}

/** The step in the direction of an arrow key, if any. */
export function neighbour(root: Lane, id: number, direction: Direction): number | undefined {
  const at = found(root, id);
  if (!at) return root.steps[0]?.id;
  const { lane, slot, parallel, branch, step } = at;
  switch (direction) {
    case 'earlier':
      return lane.steps[slot.index - 1]?.id ?? parallel?.id;
    case 'later':
      return (
        (step.kind === 'parallel' ? step.branches.find((one) => one.steps.length > 0)?.steps[0]?.id : undefined) ?? after(root, at)?.id
      );
    case 'up':
    case 'down': {
      const beside = parallel?.branches.filter((one, i) => one.steps.length > 0 && (direction === 'up' ? i < branch : i > branch));
      const next = direction === 'up' ? beside?.at(-1) : beside?.[0];
      return next?.steps[Math.min(slot.index, next.steps.length - 1)]?.id;
    }
  }
}

// The next step; at the end of a branch, the step after the parallel one.
function after(root: Lane, { lane, slot, parallel }: Found): Step | undefined {
  const next = lane.steps[slot.index + 1];
  if (next || !parallel) return next;
  const around = found(root, parallel.id);
  return around && after(root, around);
}
