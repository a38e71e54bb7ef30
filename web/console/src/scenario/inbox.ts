// Notifications that a running scenario has received and not processed.
import type { Completed, Notification, ReceiveEvent } from 'rois-client';

import type { Environment } from '../state/base/environment';

export type News = ReceiveEvent | Completed;

/** Why the inbox has ended. */
export type Ending = 'stopped' | 'session' | 'closed';

export class Inbox {
  private waiting: News[] = [];
  private wake = () => {};
  private ending: Ending | undefined;

  constructor(private readonly environment: Environment) {}

  put(notification: Notification): void {
    if (notification.name !== 'receive_event' && notification.name !== 'completed') return;
    this.waiting.push(notification);
    this.wake();
  }

  /** The first ending counts. */
  end(ending: Ending): void {
    this.ending ??= ending;
    this.wake();
  }

  get ended(): Ending | undefined {
    return this.ending;
  }

  clear(): void {
    this.waiting = [];
  }

  /** The oldest notification; undefined after `until`, or if the inbox has ended. */
  async take(until?: number): Promise<News | undefined> {
    if (this.waiting.length === 0 && this.ending === undefined && (until === undefined || until > this.environment.now()))
      await new Promise<void>((resolve) => {
        const stop = until === undefined ? () => {} : this.environment.after(until - this.environment.now(), resolve);
        this.wake = () => (stop(), resolve());
      });
    this.wake = () => {};
    return this.ending === undefined ? this.waiting.shift() : undefined;
  }
}
