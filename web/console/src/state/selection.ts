// What the user has picked, wherever: a panel that shows such things opens it.
import { signal } from '@preact/signals';

export class Selection {
  /** A component's ref; empty: none. */
  readonly component = signal('');
  /** The number of a logged document. */
  readonly document = signal<number | undefined>(undefined);
  /** One that is to be shown, whatever the filter hides: taken once. */
  readonly wanted = signal<number | undefined>(undefined);
  /** The id of the subscription whose events are to be listed; empty: none. */
  readonly subscription = signal('');
}
