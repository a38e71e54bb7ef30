// Progress of a sequence by step. The engine reports commands only; waits and branches are inferred.
import { type CommandEntry, type CommandState, has_ended } from '../state/session/commands_state';
import type { Lane, Step } from './model';
import { milliseconds } from './units';

export interface StepState {
  state: CommandState;
  since?: number; // ms since 1970: begin of this state
  took?: number; // ms, once ended
}

/** By step id; steps that were not sent are missing. */
export type RunView = ReadonlyMap<number, StepState>;

// The end of a step: a time, undefined if it has not ended, or 'failed' if it never will.
type End = number | undefined | 'failed';

export function run_view(root: Lane, entries: ReadonlyMap<number, CommandEntry>, sent_at: number, now: number): RunView {
  const view = new Map<number, StepState>();
  lane_end(root, sent_at, entries, now, view);
  return view;
}

function lane_end({ steps }: Lane, turn: End, entries: ReadonlyMap<number, CommandEntry>, now: number, view: Map<number, StepState>): End {
  let end = turn;
  for (const step of steps) end = step_end(step, end, entries, now, view);
  return end;
}

function step_end(step: Step, turn: End, entries: ReadonlyMap<number, CommandEntry>, now: number, view: Map<number, StepState>): End {
  switch (step.kind) {
    case 'command': {
      const entry = entries.get(step.id);
      if (!entry) return turn; // added after sending
      view.set(step.id, state_of_entry(entry, turn));
      return entry.state === 'OK' ? (entry.ended_at ?? now) : has_ended(entry) ? 'failed' : undefined;
    }
    case 'wait': {
      const end = typeof turn === 'number' ? turn + (milliseconds(step.time) ?? 0) : turn;
      if (end === 'failed') view.set(step.id, { state: 'ABORT' });
      else if (end === undefined) view.set(step.id, { state: 'waiting' });
      else if (end <= now) view.set(step.id, { state: 'OK', took: milliseconds(step.time) ?? 0 });
      else view.set(step.id, { state: 'running', since: turn as number });
      return end === 'failed' || (end !== undefined && end <= now) ? end : undefined;
    }
    case 'parallel': {
      const begin = typeof turn === 'number' ? turn + (milliseconds(step.delay) ?? 0) : turn;
      const ends = step.branches.map((one) => lane_end(one, begin, entries, now, view));
      const inside = step.branches
        .flatMap((one) => one.steps.map(({ id }) => view.get(id)))
        .filter((one): one is StepState => one !== undefined);
      if (inside.length === 0) return turn;
      view.set(step.id, whole_of(inside, turn));
      if (ends.includes(undefined)) return undefined;
      return ends.includes('failed') ? 'failed' : Math.max(...(ends as number[]));
    }
  }
}

// The start is reported late, and not at all for short commands: then the end of the step before counts as the start.
function state_of_entry(entry: CommandEntry, turn: End): StepState {
  const { state, ended_at } = entry;
  const started_at = entry.started_at ?? (typeof turn === 'number' ? turn : undefined);
  if (state === 'running') return { state, ...(started_at !== undefined && { since: started_at }) };
  return ended_at !== undefined && started_at !== undefined ? { state, took: Math.max(0, ended_at - started_at) } : { state };
}

// A parallel step ends when all branches have ended.
function whole_of(inside: StepState[], turn: End): StepState {
  const is_open = inside.some(({ state }) => state === 'waiting' || state === 'running');
  if (is_open) return { state: typeof turn === 'number' || inside.some(({ state }) => state !== 'waiting') ? 'running' : 'waiting' };
  return {
    state:
      inside.find(({ state }) => state !== 'OK' && state !== 'ABORT')?.state ?? inside.find(({ state }) => state !== 'OK')?.state ?? 'OK',
  };
}
