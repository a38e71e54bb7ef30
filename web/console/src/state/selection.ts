// The user's selection, shared by the panels.
import { signal } from '@preact/signals';

export class Selection {
  /** A component's ref; empty: none. */
  readonly component = signal('');
  /** The number of a logged document. */
  readonly document = signal<number | undefined>(undefined);
  /** A document to show regardless of the filter; reset when shown. */
  readonly wanted = signal<number | undefined>(undefined);
  /** The id of the subscription whose events to list; empty: none. */
  readonly subscription = signal('');
}
