// What this session has subscribed to.
import { signal } from '@preact/signals';
import { type Client, parse_xml, type ReceiveEvent, type SubscribeOptions, type Subscription, text_element, request } from 'rois-client';

import type { LoggedDocument } from './documents';
import type { Environment } from './environment';

export interface SubscriptionEntry {
  id: string; // subscribe_id
  event_type: string;
  condition: string; // as XML; empty: none
  inline_results: boolean;
  since: number; // ms since 1970
  count: number; // events so far
  last_at?: number;
}

export class SubscriptionsState {
  /** By subscribe_id. Counts change in place; the map is a new one when a subscription comes or goes. */
  readonly all = signal<ReadonlyMap<string, SubscriptionEntry>>(new Map());
  private readonly held = new Map<Subscription, { is_own: boolean }>(); // their ids change with the session

  constructor(
    private readonly environment: Environment,
    private readonly client: () => Client,
    private readonly ended: (event_type: string, error: unknown) => void,
  ) {}

  /** Outlives links and sessions. `ended` of the constructor is called when a new session refuses it. `is_own`: for what the console shows. */
  async subscribe(event_type: string, options: SubscribeOptions = {}, is_own = false): Promise<Subscription> {
    const subscription = await this.client().subscribe(event_type, options);
    this.held.set(subscription, { is_own });
    void this.drain(subscription);
    return subscription;
  }

  /** Whether the console has it for itself: nobody has asked for it. Who asks for the same has the same id. */
  is_own(id: string): boolean {
    const those = this.held_as(id);
    return those.length > 0 && those.every(([, { is_own }]) => is_own);
  }

  /** Ends it, whoever has made it; the console keeps what it has for itself. */
  async unsubscribe(id: string): Promise<void> {
    const those = this.held_as(id).filter(([, { is_own }]) => !is_own);
    if (those.length === 0) return void (await this.client().send(request('unsubscribe', {}, text_element('subscribe_id', id))));
    for (const [one] of those) this.held.delete(one);
    await Promise.all(those.map(([one]) => one.close()));
    this.all.value = new Map(this.all.value);
  }

  /** Learns from the answers, whoever has sent the requests. */
  heard({ name, return_code, text, request: asked, at }: LoggedDocument): void {
    if (return_code !== 'OK' || asked === undefined) return;
    if (name === 'subscribe_response') {
      const id = parse_xml(text).text_of('subscribe_id');
      const wanted = parse_xml(asked.text);
      const condition = /<(?:[\w.-]+:)?condition>([^]*)<\/(?:[\w.-]+:)?condition>/.exec(asked.text)?.[1] ?? '';
      const before = this.all.value.get(id);
      const inline_results = /^(true|1)$/.test(wanted.attribute('inline_results') ?? '');
      const entry = { id, event_type: wanted.text_of('event_type'), condition, inline_results, since: at, count: 0, ...(before && { count: before.count, since: before.since }) };
      this.all.value = new Map([...this.all.value, [id, entry]]);
    }
    if (name === 'unsubscribe_response') this.remove(parse_xml(asked.text).text_of('subscribe_id'));
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

  private held_as(id: string): [Subscription, { is_own: boolean }][] {
    return [...this.held].filter(([one]) => one.subscribe_id === id);
  }

  private remove(id: string): void {
    this.all.value = new Map([...this.all.value].filter(([one]) => one !== id));
  }

  // What it brings is heard as a notification; its own stream must not fill.
  private async drain(subscription: Subscription): Promise<void> {
    try {
      for await (const _ of subscription);
    } catch (error) {
      this.ended(subscription.wanted.event_type, error);
    }
    this.held.delete(subscription);
  }
}
