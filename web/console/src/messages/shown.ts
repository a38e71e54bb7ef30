// State of the panel, kept while another panel is shown.
import { signal } from '@preact/signals';

import type { Recording } from '../state/session/recording';
import { type Filter, no_filter, type Row } from './feed';

export interface ShownRecording extends Recording {
  file: string;
}

export const filter = signal<Filter>(no_filter);
/** The open recording; undefined: live. */
export const recording = signal<ShownRecording | undefined>(undefined);
/** The rows when the user paused the list. */
export const paused = signal<{ rows: readonly Row[]; until: number } | undefined>(undefined);
/** The selected document of a recording. Live: `console.selection.document`. */
export const chosen_of_recording = signal<number | undefined>(undefined);
