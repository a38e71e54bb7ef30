// Limits updates to one for each frame.
import { signal } from '@preact/signals';

import type { Environment } from './environment';

/**
 * The version of something that changes often and in place. Readers read `beat.value` and then the thing. It beats at most once a frame.
 */
export class Pulse {
  readonly beat = signal(0);
  private is_due = false;

  constructor(private readonly environment: Pick<Environment, 'before_frame'>) {}

  touch(): void {
    if (this.is_due) return;
    this.is_due = true;
    this.environment.before_frame(() => {
      this.is_due = false;
      this.beat.value += 1;
    });
  }
}
