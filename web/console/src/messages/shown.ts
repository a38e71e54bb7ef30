// What the panel shows; it outlives the panel, which is taken down when another one is chosen.
import { signal } from '@preact/signals';

import type { Recording } from '../state/recording';
import { type Filter, no_filter, type Row } from './feed';

export interface ShownRecording extends Recording {
  file: string;
}

export const filter = signal<Filter>(no_filter);
/** A recording that is read in place of what happens. */
export const recording = signal<ShownRecording | undefined>(undefined);
/** The rows as they were when the user stopped time. */
export const paused = signal<{ rows: readonly Row[]; until: number } | undefined>(undefined);
/** Of the recording: the number of the document that is read. Of what happens it is `console.selection.document`. */
export const chosen_of_recording = signal<number | undefined>(undefined);
