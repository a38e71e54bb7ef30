// Storage of an unfinished sequence across visits.
import { copy_of, type Lane, new_lane, type Step } from './model';

export function draft_text(root: Lane): string {
  return JSON.stringify(root);
}

/** Undefined if invalid; ids are new. */
export function draft_of(text: string | undefined): Lane | undefined {
  try {
    const { steps } = JSON.parse(text ?? '') as Lane;
    return steps.every(is_step) ? new_lane(steps.map(copy_of)) : undefined;
  } catch {
    return undefined;
  }
}

function is_step(step: Step): boolean {
  if (step.kind === 'wait') return typeof step.time === 'string';
  if (step.kind === 'command') return typeof step.component === 'string' && typeof step.inputs === 'object' && Array.isArray(step.unknown);
  return step.kind === 'parallel' && step.branches.every((one) => one.steps.every(is_step));
}
