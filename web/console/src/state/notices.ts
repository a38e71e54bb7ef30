// What the user is told without having looked for it: at the edge of the page, and aloud by a screen reader.
import { signal } from '@preact/signals';

import type { Environment } from './environment';

export type Severity = 'info' | 'good' | 'warning' | 'error';

/** Something that happened. Its text is in the user's language already. */
export interface Notice {
  number: number;
  at: number;
  severity: Severity;
  text: string;
  detail?: string;
  /** What the user may do about it: an undo, say. */
  action?: { label: string; act(): void };
  /** What it is about: what is told of it later takes its place. */
  about?: string;
}

const most_notices = 2;

export class Notices {
  readonly list = signal<readonly Notice[]>([]);
  private next = 1;

  constructor(private readonly environment: Pick<Environment, 'now' | 'after'>) {}

  tell(severity: Severity, text: string, more: Pick<Notice, 'detail' | 'action' | 'about'> = {}): number {
    const notice: Notice = { number: this.next++, at: this.environment.now(), severity, text, ...more };
    const others = this.list.value.filter((one) => one.about === undefined || one.about !== notice.about);
    this.list.value = [...others, notice].slice(-most_notices);
    this.environment.after(severity === 'error' ? 30_000 : 8000, () => this.dismiss(notice.number));
    return notice.number;
  }

  /** One by its number, or all that was told `about` something: it has come to a good end since. */
  dismiss(which: number | string): void {
    const others = this.list.value.filter((one) => one.number !== which && one.about !== which);
    if (others.length < this.list.value.length) this.list.value = others;
  }
}
