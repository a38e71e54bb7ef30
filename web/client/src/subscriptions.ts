// What a client has subscribed to, and who reads it.
import type { ReceiveEvent } from './messages.js';
import type { Writable } from './requests.js';
import { Stream } from './stream.js';

/** What is subscribed to. */
export interface Wanted {
  event_type: string;
  condition: Writable | undefined;
  inline_results: boolean;
}

/**
 * The events of one subscription, as an async iterable: `for await (const event of subscription)`. It outlives links and sessions, until it
 * is closed; then the iteration ends. When a new session refuses it, the iteration fails with this error.
 */
export class Subscription extends Stream<ReceiveEvent> {
  /** The engine's name for it; another one after a new session. */
  subscribe_id = '';

  constructor(
    readonly wanted: Wanted,
    capacity: number,
    dropped: (count: number) => void,
    private readonly leave: (subscription: Subscription) => Promise<void>,
  ) {
    super(capacity, dropped);
  }

  /** Unsubscribes. What has come already can still be read. */
  async close(): Promise<void> {
    this.end();
    await this.leave(this);
  }
}

/** All of a client, by the engine's names for them. */
export class Subscriptions {
  private readonly by_id = new Map<string, Set<Subscription>>();
  private readonly all = new Set<Subscription>();

  /** One that is new, or has no name since the names were forgotten. */
  add(subscription: Subscription, subscribe_id: string): void {
    subscription.subscribe_id = subscribe_id;
    this.all.add(subscription);
    this.by_id.set(subscribe_id, (this.by_id.get(subscribe_id) ?? new Set()).add(subscription));
  }

  /** Whether it was the last of its id. */
  remove(subscription: Subscription): boolean {
    const those = this.by_id.get(subscription.subscribe_id);
    this.all.delete(subscription);
    if (!those?.delete(subscription) || those.size > 0) return false;
    return this.by_id.delete(subscription.subscribe_id);
  }

  /** The session that gave the names is gone. */
  forget_ids(): void {
    this.by_id.clear();
  }

  /** A copy: it may be changed meanwhile. */
  list(): Subscription[] {
    return [...this.all];
  }

  tell(event: ReceiveEvent): void {
    for (const subscription of this.by_id.get(event.subscribe_id) ?? []) subscription.push(event);
  }
}
