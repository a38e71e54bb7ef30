// Tells of changes no more often than pictures are drawn.
import { signal } from '@preact/signals';

import type { Environment } from './environment';

/**
 * The version of something that changes often and in place. Whoever shows it reads `beat.value` and then the thing itself; however many
 * changes there were since the last picture, they are told once.
 */
export class Pulse {
  readonly beat = signal(0);
  private is_due = false;

  constructor(private readonly environment: Pick<Environment, 'before_picture'>) {}

  touch(): void {
    if (this.is_due) return;
    this.is_due = true;
    this.environment.before_picture(() => {
      this.is_due = false;
      this.beat.value += 1;
    });
  }
}
