// The context that lanes, boxes and gaps of the drawing share.
import type { Drag } from './drag';
import type { Slot } from './model';
import type { RunView } from './running';
import type { SequenceStore } from './store';

export interface LaneContext {
  store: SequenceStore;
  view: RunView;
  adding: Slot | undefined;
  set_adding: (slot: Slot | undefined) => void;
  drag: Drag;
  /** The step with the Tab stop. */
  first: number | undefined;
  go_to: (step: number) => void;
  /** Moves the focus to the form of the selected step. */
  open_form: () => void;
}
