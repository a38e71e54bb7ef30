// Persons, faces and sound sources, from the events of localization and identification.
import type { ReceiveEvent, Subscription } from 'rois-client';

import type { Environment, Stop } from '../base/environment';
import { Pulse } from '../base/pulse';
import { Watchers } from '../base/watchers';
import { type Entity, kind_of_event, located_in, placed } from './things';

const most_entities = 500;
const forgotten_after = 30_000; // ms since the last event
const same_event = 500; // ms between two notifications of one event
const same_place = 1000; // mm: an identified person at the place of a tracked one is the same person

/** The event types used; the last one reports when there are no persons. */
const entity_events = ['person_localized', 'face_localized', 'sound_localized', 'person_identified', 'person_detected'];

export class EntitiesState {
  /** By kind and ref: `person person-1`. Entries change in place: read `pulse.beat.value` first. */
  readonly all = new Map<string, Entity>();
  readonly pulse: Pulse;
  /** Time of the last event with results in ms since 1970; 0: none yet. */
  reported_at = 0;
  private readonly watchers = new Watchers(() => this.begin(), () => this.end());
  private readonly subscribed = new Map<string, Promise<Subscription | undefined>>();
  private stop_clock = () => {};

  constructor(
    private readonly environment: Environment,
    private readonly subscribe: (event_type: string) => Promise<Subscription>,
    private readonly has_own_results: (event_type: string) => boolean,
    private readonly has_event: (event_type: string) => boolean,
    private readonly engine_of: (component: string) => string,
  ) {
    this.pulse = new Pulse(environment);
  }

  /** Subscribes to these events while at least one caller watches. Does not start the components. */
  watch(): Stop {
    return this.watchers.watch();
  }

  private begin(): void {
    this.stop_clock = this.environment.every(1000, () => this.forget_old());
    this.profile_changed();
  }

  private end(): void {
    this.stop_clock();
    for (const subscription of this.subscribed.values()) void subscription.then((one) => one?.close().catch(() => undefined));
    this.subscribed.clear();
  }

  /** Subscribes to event types that are new in the profile. */
  profile_changed(): void {
    if (!this.watchers.any) return;
    for (const event_type of entity_events)
      if (!this.subscribed.has(event_type) && this.has_event(event_type))
        this.subscribed.set(
          event_type,
          this.subscribe(event_type).catch(() => {
            this.subscribed.delete(event_type);
            return undefined;
          }),
        );
  }

  /** Updates from an event of any subscription. */
  event(event: ReceiveEvent): void {
    const kind = kind_of_event(event);
    const has_results = event.results.parameters.length > 0 || event.results.located.length > 0;
    if (has_results && entity_events.includes(event.event_type)) this.reported_at = this.environment.now();
    if (kind && !has_results) this.without_results(kind, event.component_ref.code);
    else if (kind) this.localized(kind, event);
    else if (event.event_type === 'person_identified') this.identified(event);
    else if (event.event_type === 'person_detected' && event.results.number('number') === 0) this.none_detected(event);
  }

  /** Whether positions are unknown: an event type has no subscription, or its events have no results. */
  is_blind(): boolean {
    const lacks_results = (event_type: string) => this.has_event(event_type) && !this.has_own_results(event_type);
    return entity_events.some(lacks_results) || [...this.all.values()].some((one) => one.unknown_since !== undefined);
  }

  forget(): void {
    this.reported_at = 0;
    this.all.clear();
    this.pulse.touch();
  }

  // An event without results: something moved, came or left, but which is unknown. The same event may arrive again with results.
  private without_results(kind: Entity['kind'], component: string): void {
    const now = this.environment.now();
    for (const entity of this.all.values())
      if (entity.component === component && entity.kind === kind && now - entity.at > same_event) entity.unknown_since ??= now;
    this.pulse.touch();
  }

  // The event lists all that the component sees, so all others are out of its sight.
  private localized(kind: Entity['kind'], event: ReceiveEvent): void {
    const component = event.component_ref.code;
    const at = this.environment.now();
    const codebook = event.results.get(`${kind}_ref`)?.data_type_ref.codebook_ref ?? '';
    const seen = new Set<string>();
    for (const located of located_in(event.results, `${kind}_ref`)) {
      const key = `${kind} ${located.ref}`;
      const entity = placed(this.all.get(key), located, { codebook, component, at }, (thing): Entity => ({
        ...thing,
        kind,
        is_seen: true,
      }));
      entity.is_seen = true;
      delete entity.unknown_since;
      seen.add(key);
      this.all.set(key, entity);
    }
    for (const [key, entity] of this.all)
      if (entity.component === component && entity.kind === kind && !seen.has(key)) entity.is_seen = false;
    for (const key of this.all.keys()) {
      if (this.all.size <= most_entities) break;
      this.all.delete(key);
    }
    this.pulse.touch();
  }

  // Localization does not report that the last person has left; detection does.
  private none_detected(event: ReceiveEvent): void {
    const engine = this.engine_of(event.component_ref.code);
    for (const entity of this.all.values())
      if (entity.kind !== 'sound' && this.engine_of(entity.component) === engine) entity.is_seen = false;
    this.pulse.touch();
  }

  // Identification uses another code than tracking. An identified person at the place of a tracked one is the same.
  private identified(event: ReceiveEvent): void {
    const codebook = event.results.get('person_ref')?.data_type_ref.codebook_ref ?? '';
    for (const located of located_in(event.results, 'person_ref', 'person_ref')) {
      const [x, y] = located.position;
      let nearest: Entity | undefined;
      for (const entity of this.all.values()) {
        if (entity.kind !== 'person') continue;
        const away = Math.hypot(entity.x - x, entity.y - y);
        if (away <= same_place && (!nearest || away < Math.hypot(nearest.x - x, nearest.y - y))) nearest = entity;
      }
      if (nearest) nearest.identity = { ref: located.ref, codebook, at: this.environment.now() };
    }
    this.pulse.touch();
  }

  private forget_old(): void {
    const now = this.environment.now();
    let changed = false;
    for (const [key, entity] of this.all)
      if (!entity.is_seen && now - entity.at > forgotten_after) changed = this.all.delete(key);
    if (changed) this.pulse.touch();
  }
}
