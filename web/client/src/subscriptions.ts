// Subscriptions of a client.
import type { ReceiveEvent } from './messages.js';
import type { Writable } from './requests.js';
import { Stream } from './stream.js';

/** The arguments of a subscription. */
export interface Wanted {
  event_type: string;
  condition: Writable | undefined;
  inline_results: boolean;
}

/**
 * The events of one subscription, an async iterable: `for await (const event of subscription)`. Survives new links and sessions. The
 * iteration ends when it is closed, and throws if a new session refuses it.
 */
export class Subscription extends Stream<ReceiveEvent> {
  /** The engine's id; changes with a new session. */
  subscribe_id = '';

  constructor(
    readonly wanted: Wanted,
    capacity: number,
    dropped: (count: number) => void,
    private readonly leave: (subscription: Subscription) => Promise<void>,
  ) {
    super(capacity, dropped);
  }

  /** Unsubscribes. Events that have arrived can still be read. */
  async close(): Promise<void> {
    this.end();
    await this.leave(this);
  }
}

/** All subscriptions of a client, by the engine's ids. */
export class Subscriptions {
  private readonly by_id = new Map<string, Set<Subscription>>();
  private readonly all = new Set<Subscription>();

  /** Adds a subscription that is new or has lost its id. */
  add(subscription: Subscription, subscribe_id: string): void {
    subscription.subscribe_id = subscribe_id;
    this.all.add(subscription);
    this.by_id.set(subscribe_id, (this.by_id.get(subscribe_id) ?? new Set()).add(subscription));
  }

  /** Returns whether it was the last with its id. */
  remove(subscription: Subscription): boolean {
    const same_id = this.by_id.get(subscription.subscribe_id);
    this.all.delete(subscription);
    if (!same_id?.delete(subscription) || same_id.size > 0) return false;
    return this.by_id.delete(subscription.subscribe_id);
  }

  /** The session that issued the ids is lost. */
  forget_ids(): void {
    this.by_id.clear();
  }

  /** Returns a copy: the set may change while the caller iterates. */
  list(): Subscription[] {
    return [...this.all];
  }

  notify(event: ReceiveEvent): void {
    for (const subscription of this.by_id.get(event.subscribe_id) ?? []) subscription.push(event);
  }
}
