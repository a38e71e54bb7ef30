// Selection and input of the Visitors panel. Both survive a change of panels; so does running time.
import { signal } from '@preact/signals';

import type { Console } from '../state/console';
import type { Outcome } from '../state/floor/hall_state';
import { error_text } from '../ui';
import * as texts from './texts';

export const languages = ['de', 'en', 'es', 'fr', 'it', 'ja', 'ko', 'zh'] as const;
const names = ['anna', 'ben', 'chika', 'daniel', 'emi', 'farid', 'grace', 'hiro'];
const flow_step = 100; // ms, both simulated and real

export class Steering {
  /** Ref of the selected visitor. */
  readonly chosen = signal('');
  readonly language = signal<string>('en');
  readonly is_known = signal(false);
  /** As typed; empty: the next free name. */
  readonly name = signal('');
  readonly words = signal('');
  readonly spoken = signal(''); // language; empty: the visitor's own
  readonly place = signal('');
  readonly flows = signal(false);

  constructor(private readonly console: Console) {}

  /** A name that is not used in the hall. */
  next_name(): string {
    for (let round = 1; ; ++round) {
      const free = names.map((one) => (round === 1 ? one : `${one}${round}`)).find((one) => !this.console.hall.is_taken(one));
      if (free !== undefined) return free;
    }
  }

  /** Waits for an order and shows a notice if it fails. `replaced` orders end with ABORT, which is not a failure. */
  async order(ref: string, what: string, ordered: Promise<Outcome>): Promise<boolean> {
    const { notices } = this.console;
    const about = `${ref} ${what}`;
    try {
      const { status, reason } = await ordered;
      if (status === 'ERROR' || status === 'TIMEOUT' || status === 'OUT_OF_RESOURCES')
        notices.show('warning', texts.not_done(ref, what), { about, detail: reason });
      else notices.dismiss(about);
      return status === 'OK';
    } catch (error) {
      notices.show('error', texts.not_done(ref, what), { about, detail: error_text(error) });
      return false;
    }
  }

  enter(): void {
    const ref = this.name.value.trim() || this.next_name();
    this.chosen.value = ref;
    this.name.value = '';
    void this.order(ref, 'enter', this.console.hall.enter(ref, { language: this.language.value, known: this.is_known.value }));
  }

  async pass(ms: number): Promise<boolean> {
    try {
      return (await this.console.hall.let_pass(ms)).status === 'OK';
    } catch (error) {
      this.console.notices.show('error', error_text(error), { about: 'time' });
      return false;
    }
  }

  /** Lets time pass at real speed until `halt`. */
  async flow(): Promise<void> {
    const { environment } = this.console;
    this.flows.value = true;
    while (this.flows.value) {
      const began = environment.now();
      if (!(await this.pass(flow_step))) break;
      await new Promise<void>((resolve) => environment.after(Math.max(0, began + flow_step - environment.now()), resolve));
    }
    this.flows.value = false;
  }

  halt(): void {
    this.flows.value = false;
  }
}

const all = new WeakMap<Console, Steering>();

export function steering_of(console: Console): Steering {
  const steering = all.get(console) ?? new Steering(console);
  all.set(console, steering);
  return steering;
}
