// The subscriptions of this session.
import { signal } from '@preact/signals';
import {
  type Client,
  condition_xml,
  not,
  parse_xml,
  property,
  type ReceiveEvent,
  type SubscribeOptions,
  type Subscription,
  text_element,
  request,
} from 'rois-client';

import type { Environment } from '../base/environment';
import type { LoggedDocument } from './document_log';
import type { Documents } from './documents';

export interface SubscriptionEntry {
  id: string; // subscribe_id
  event_type: string;
  condition: string; // as XML; empty: none
  inline_results: boolean;
  since: number; // ms since 1970
  count: number; // events received
  last_at?: number;
}

// Matches every event. The engine identifies subscriptions by type and condition, so the console's own differ from the user's.
const own_condition = not(property('component_ref').is_null());

export class SubscriptionsState {
  /** By subscribe_id. Counts change in place; adding or removing a subscription makes a new map. */
  readonly all = signal<ReadonlyMap<string, SubscriptionEntry>>(new Map());
  private readonly held = new Map<Subscription, { is_own: boolean }>(); // ids change with the session

  constructor(
    private readonly environment: Environment,
    private readonly documents: Documents,
    private readonly client: () => Client,
    private readonly ended: (event_type: string, error: unknown) => void,
  ) {}

  /** Subscribes across links and sessions. `ended` of the constructor is called if a new session refuses it. */
  subscribe(event_type: string, options: SubscribeOptions = {}): Promise<Subscription> {
    return this.hold(this.client().subscribe(event_type, options), false);
  }

  /** Subscribes for the console's own display: with results, independent of the user's subscriptions. */
  subscribe_own(event_type: string): Promise<Subscription> {
    return this.hold(this.documents.as_own(() => this.client().subscribe(event_type, { condition: own_condition })), true);
  }

  /** Whether only the console itself uses it. Equal subscriptions share an id. */
  is_own(id: string): boolean {
    const subscriptions = this.held_as(id);
    return subscriptions.length > 0 && subscriptions.every(([, { is_own }]) => is_own);
  }

  /** Whether the console's own subscription to this type delivers results. */
  has_own_results(event_type: string): boolean {
    return [...this.held].some(
      ([one, { is_own }]) => is_own && one.wanted.event_type === event_type && this.all.value.get(one.subscribe_id)?.inline_results,
    );
  }

  /** Ends the user's subscription. The console keeps its own. */
  async unsubscribe(id: string): Promise<void> {
    const subscriptions = this.held_as(id).filter(([, { is_own }]) => !is_own);
    if (subscriptions.length === 0) return void (await this.client().send(request('unsubscribe', {}, text_element('subscribe_id', id))));
    for (const [one] of subscriptions) this.held.delete(one);
    await Promise.all(subscriptions.map(([one]) => one.close()));
    this.all.value = new Map(this.all.value);
  }

  /** Updates from an answer, whether the user or the console sent the request. */
  on_answer({ name, return_code, text, request: asked, at }: LoggedDocument): void {
    if (return_code !== 'OK' || asked === undefined) return;
    if (name === 'subscribe_response') {
      const id = parse_xml(text).text_of('subscribe_id');
      const wanted = parse_xml(asked.text);
      const condition = /<(?:[\w.-]+:)?condition>([^]*)<\/(?:[\w.-]+:)?condition>/.exec(asked.text)?.[1] ?? '';
      const before = this.all.value.get(id);
      const inline_results = /^(true|1)$/.test(wanted.attribute('inline_results') ?? '');
      const entry = {
        id,
        event_type: wanted.text_of('event_type'),
        condition,
        inline_results,
        since: at,
        count: 0,
        ...(before && { count: before.count, since: before.since }),
      };
      this.all.value = new Map([...this.all.value, [id, entry]]);
      if (!inline_results) this.want_results(id);
    }
    if (name === 'unsubscribe_response') {
      const id = parse_xml(asked.text).text_of('subscribe_id');
      this.remove(id);
      this.make_again(id);
    }
  }

  event(event: ReceiveEvent): void {
    const entry = this.all.value.get(event.subscribe_id);
    if (!entry) return;
    entry.count += 1;
    entry.last_at = this.environment.now();
  }

  forget_session(): void {
    this.all.value = new Map();
  }

  private async hold(asked: Promise<Subscription>, is_own: boolean): Promise<Subscription> {
    const subscription = await asked;
    this.held.set(subscription, { is_own });
    void this.drain(subscription);
    return subscription;
  }

  // The user sent a document equal to the console's own subscription, without results: requests results again.
  private want_results(id: string): void {
    const own = this.own_as(id);
    if (!own) return;
    const text = request(
      'subscribe',
      { inline_results: true },
      text_element('event_type', own.wanted.event_type) + condition_xml(own_condition),
    );
    this.documents.as_own(() => this.client().send(text)).catch(() => undefined); // shown by the map's badge
  }

  // The user unsubscribed the console's own subscription: makes a new one, which gets another id.
  private make_again(id: string): void {
    const own = this.own_as(id);
    if (!own) return;
    this.held.delete(own);
    this.documents.as_own(() => own.close()).catch(() => undefined); // so that the client does not repeat it, too
    this.subscribe_own(own.wanted.event_type).catch(() => undefined); // shown by the map's badge
  }

  private own_as(id: string): Subscription | undefined {
    return this.held_as(id).find(([one, { is_own }]) => is_own && !one.ended)?.[0];
  }

  private held_as(id: string): [Subscription, { is_own: boolean }][] {
    return [...this.held].filter(([one]) => one.subscribe_id === id);
  }

  private remove(id: string): void {
    this.all.value = new Map([...this.all.value].filter(([one]) => one !== id));
  }

  // Events are processed as notifications; empties the stream so that it does not overflow.
  private async drain(subscription: Subscription): Promise<void> {
    try {
      for await (const _ of subscription);
    } catch (error) {
      this.ended(subscription.wanted.event_type, error);
    }
    this.held.delete(subscription);
  }
}
