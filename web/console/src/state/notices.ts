// Notices: messages at the edge of the page, also announced by screen readers.
import { signal } from '@preact/signals';

import type { Environment } from './base/environment';

export type Severity = 'info' | 'good' | 'warning' | 'error';

/** A notice. Its text is in the user's language. */
export interface Notice {
  number: number;
  severity: Severity;
  text: string;
  detail?: string;
  /** An action offered to the user, such as undo. */
  action?: { label: string; act(): void };
  /** The subject. A later notice about it replaces this one. */
  about?: string;
}

const most_notices = 2;

export class Notices {
  readonly list = signal<readonly Notice[]>([]);
  private next = 1;

  constructor(private readonly environment: Pick<Environment, 'after'>) {}

  show(severity: Severity, text: string, more: Pick<Notice, 'detail' | 'action' | 'about'> = {}): number {
    const notice: Notice = { number: this.next++, severity, text, ...more };
    const others = this.list.value.filter((one) => one.about === undefined || one.about !== notice.about);
    this.list.value = [...others, notice].slice(-most_notices);
    this.environment.after(severity === 'error' ? 30_000 : 8000, () => this.dismiss(notice.number));
    return notice.number;
  }

  /** Removes a notice by number, or all `about` a subject. */
  dismiss(which: number | string): void {
    const others = this.list.value.filter((one) => one.number !== which && one.about !== which);
    if (others.length < this.list.value.length) this.list.value = others;
  }
}
