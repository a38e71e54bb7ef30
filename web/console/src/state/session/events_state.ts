// Received events, errors, switches and gaps.
import { type Client, type Gap, type ReceiveError, type ReceiveEvent, type Results, RoisError, type Switched } from 'rois-client';

import type { Environment } from '../base/environment';
import { Pulse } from '../base/pulse';
import { Ring } from '../base/ring';
import type { Documents } from './documents';

/** State of the details: not requested, requested, available, or gone (expired or of another session). */
export type Details = { state: 'none' | 'asked' } | { state: 'there'; results: Results } | { state: 'gone'; reason: string };

export interface EventEntry {
  number: number; // from 0 for each kind
  at: number; // ms since 1970
  event: ReceiveEvent;
  document: number; // number of the logged document
  details: Details;
}

export interface ErrorEntry {
  number: number;
  at: number;
  error: ReceiveError;
  document: number;
  details: Details;
}

/** A logical component goes on with another member. */
export interface SwitchEntry {
  number: number;
  at: number;
  switched: Switched;
  document: number;
}

export interface GapEntry {
  at: number;
  gap: Gap;
}

/** The entries before a reload of the page. */
export interface EarlierEvents {
  events: EventEntry[];
  own_events: EventEntry[];
  errors: ErrorEntry[];
  switches: SwitchEntry[];
  gaps: GapEntry[];
}

const most_events = 5000;
const most_own_events = 1000;
const most_errors = 500;
const most_switches = 500;
const most_gaps = 100;
const most_fetched_at_once = 8;

export class EventsState {
  readonly events = new Ring<EventEntry>(most_events);
  /** Events of the console's own subscriptions. They are frequent and must not displace the user's. */
  readonly own_events = new Ring<EventEntry>(most_own_events);
  readonly errors = new Ring<ErrorEntry>(most_errors);
  readonly switches = new Ring<SwitchEntry>(most_switches);
  readonly gaps = new Ring<GapEntry>(most_gaps);
  readonly pulse: Pulse;
  private next_event = 0;
  private next_error = 0;
  private next_switch = 0;
  private fetching = 0;

  constructor(
    private readonly environment: Environment,
    private readonly documents: Documents,
    private readonly client: () => Client | undefined,
  ) {
    this.pulse = new Pulse(environment);
  }

  event(event: ReceiveEvent, document: number, is_own = false): EventEntry {
    const details: Details = event.results.parameters.length > 0 ? { state: 'there', results: event.results } : { state: 'none' };
    const entry: EventEntry = { number: this.next_event++, at: this.environment.now(), event, document, details };
    (is_own ? this.own_events : this.events).push(entry);
    this.pulse.touch();
    return entry;
  }

  /** Adds an error. Its details are fetched automatically, unless errors flood in. */
  error(error: ReceiveError, document: number): ErrorEntry {
    const entry: ErrorEntry = { number: this.next_error++, at: this.environment.now(), error, document, details: { state: 'none' } };
    this.errors.push(entry);
    this.pulse.touch();
    if (this.fetching < most_fetched_at_once) void this.fetch_error(entry);
    return entry;
  }

  switched(switched: Switched, document: number): void {
    this.switches.push({ number: this.next_switch++, at: this.environment.now(), switched, document });
    this.pulse.touch();
  }

  /** Adds the entries of this page before its reload. */
  recall({ events, own_events, errors, switches, gaps }: EarlierEvents): void {
    for (const one of gaps) this.gaps.push(one);
    for (const one of switches) this.switches.push({ ...one, number: this.next_switch++ });
    for (const one of events) this.events.push({ ...one, number: this.next_event++ });
    for (const one of own_events) this.own_events.push({ ...one, number: this.next_event++ });
    for (const one of errors) this.errors.push({ ...one, number: this.next_error++ });
    this.pulse.touch();
  }

  gap(gap: Gap): void {
    this.gaps.push({ at: this.environment.now(), gap });
    this.pulse.touch();
  }

  /** Whether the engine no longer has the details. */
  is_expired({ event }: EventEntry): boolean {
    return event.expire.getTime() <= this.environment.now();
  }

  fetch_event(entry: EventEntry): Promise<void> {
    return this.fetch(entry, (client) => client.get_event_detail(entry.event.event_id));
  }
  fetch_error(entry: ErrorEntry): Promise<void> {
    return this.fetch(entry, (client) => client.get_error_detail(entry.error.error_id));
  }

  private async fetch(entry: { details: Details }, ask: (client: Client) => Promise<Results>): Promise<void> {
    const client = this.client();
    if (!client || entry.details.state === 'asked' || entry.details.state === 'there') return;
    entry.details = { state: 'asked' };
    this.fetching += 1;
    this.pulse.touch();
    try {
      entry.details = { state: 'there', results: await this.documents.as_own(() => ask(client)) };
    } catch (error) {
      entry.details = { state: 'gone', reason: error instanceof RoisError ? error.message : String(error) };
    }
    this.fetching -= 1;
    this.pulse.touch();
  }
}
