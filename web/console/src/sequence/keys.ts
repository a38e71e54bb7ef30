// Keyboard input of the drawing.
import { type Direction, neighbour, slot_towards, with_moved, without } from './model';
import type { SequenceStore } from './store';

const arrows: Record<string, Direction> = { ArrowLeft: 'earlier', ArrowRight: 'later', ArrowUp: 'up', ArrowDown: 'down' };

export interface KeyActions {
  /** Moves the focus to a step. */
  go_to(step: number): void;
  /** Opens the menu to add a step after it. */
  add(): void;
  /** Moves the focus to the form of the step. */
  open(): void;
}

/** Returns whether the key was handled. */
export function step_key(event: KeyboardEvent, store: SequenceStore, { go_to, add, open }: KeyActions): boolean {
  const step = store.chosen.value;
  const direction = arrows[event.key];
  if (direction && event.altKey) move(store, step, direction);
  else if (direction) {
    const next = neighbour(store.root.value, step, direction);
    if (next !== undefined) go_to(next);
  } else if (event.key === 'Delete' || event.key === 'Backspace') {
    const next = neighbour(store.root.value, step, 'earlier') ?? store.root.value.steps.find((one) => one.id !== step)?.id;
    store.change(without(store.root.value, step));
    store.chosen.value = 0;
    if (next !== undefined) go_to(next);
  } else if (event.key === 'Insert' || event.key === '+') add();
  else if (event.key === 'Enter' || event.key === 'F2') open();
  else if (event.key === 'z' && (event.ctrlKey || event.metaKey)) store.undo();
  else return false;
  return true;
}

export function move(store: SequenceStore, step: number, direction: Direction): void {
  const to = slot_towards(store.root.value, step, direction);
  if (to) store.change(with_moved(store.root.value, step, to));
}
