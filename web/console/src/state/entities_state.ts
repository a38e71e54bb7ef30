// People, faces and sound sources, as the events of localization and identification tell them.
import type { ReceiveEvent, Subscription } from 'rois-client';

import type { Environment, Stop } from './environment';
import { Pulse } from './pulse';
import { type Entity, kind_told_by, located_in, placed } from './things';

const most_entities = 500;
const forgotten_after = 30_000; // ms since it was told of
const same_event = 500; // ms between two notifications of it
const same_place = 1000; // mm: somebody who is identified there is the one who is tracked there

/** The events that tell of them; the last one tells when there is nobody. */
export const entity_events = ['person_localized', 'face_localized', 'sound_localized', 'person_identified', 'person_detected'];

export class EntitiesState {
  /** By kind and ref: `person person-1`. They change in place: read `pulse.beat.value`, then this. */
  readonly all = new Map<string, Entity>();
  readonly pulse: Pulse;
  /** When an event with results came last; 0 before the first. ms since 1970. */
  told_at = 0;
  private lookers = 0;
  private readonly subscribed = new Map<string, Promise<Subscription | undefined>>();
  private stop_clock: Stop | undefined;

  constructor(
    private readonly environment: Environment,
    private readonly subscribe: (event_type: string) => Promise<Subscription>,
    private readonly is_fed: (event_type: string) => boolean,
    private readonly has_event: (event_type: string) => boolean,
    private readonly engine_of: (component: string) => string,
  ) {
    this.pulse = new Pulse(environment);
  }

  /** Subscribes to what tells of them while somebody looks. It does not start the components that do. */
  watch(): Stop {
    this.lookers += 1;
    if (this.lookers === 1) this.stop_clock = this.environment.every(1000, () => this.forget_old());
    this.profile_changed();
    let looks = true;
    return () => {
      if (!looks) return;
      looks = false;
      this.lookers -= 1;
      if (this.lookers > 0) return;
      this.stop_clock?.();
      for (const subscription of this.subscribed.values()) void subscription.then((one) => one?.close().catch(() => undefined));
      this.subscribed.clear();
    };
  }

  /** Subscribes to events that the engine has got since. */
  profile_changed(): void {
    if (this.lookers === 0) return;
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

  /** Learns from every event, whoever has subscribed to it. */
  event(event: ReceiveEvent): void {
    const kind = kind_told_by(event);
    const has_results = event.results.parameters.length > 0 || event.results.located.length > 0;
    if (has_results && entity_events.includes(event.event_type)) this.told_at = this.environment.now();
    if (kind && !has_results) this.not_told(kind, event.component_ref.code);
    else if (kind) this.localized(kind, event);
    else if (event.event_type === 'person_identified') this.identified(event);
    else if (event.event_type === 'person_detected' && event.results.number('number') === 0) this.nobody_there(event);
  }

  /** Whether what they do is not told: an event is not subscribed to, or comes without results. */
  is_blind(): boolean {
    const is_unfed = (event_type: string) => this.has_event(event_type) && !this.is_fed(event_type);
    return entity_events.some(is_unfed) || [...this.all.values()].some((one) => one.unknown_since !== undefined);
  }

  forget(): void {
    this.told_at = 0;
    this.all.clear();
    this.pulse.touch();
  }

  // Somebody has moved, come or gone, and nobody knows who. The same event may come twice, with results and without.
  private not_told(kind: Entity['kind'], component: string): void {
    const now = this.environment.now();
    for (const entity of this.all.values()) if (entity.component === component && entity.kind === kind && now - entity.at > same_event) entity.unknown_since ??= now;
    this.pulse.touch();
  }

  // It tells of all that it sees, so whoever is not among them is out of its sight.
  private localized(kind: Entity['kind'], event: ReceiveEvent): void {
    const component = event.component_ref.code;
    const at = this.environment.now();
    const codebook = event.results.get(`${kind}_ref`)?.data_type_ref.codebook_ref ?? '';
    const seen = new Set<string>();
    for (const located of located_in(event.results, `${kind}_ref`)) {
      const key = `${kind} ${located.ref}`;
      const entity = placed(this.all.get(key), located, { codebook, component, at }, (thing): Entity => ({ ...thing, kind, is_seen: true }));
      entity.is_seen = true;
      delete entity.unknown_since;
      seen.add(key);
      this.all.set(key, entity);
    }
    for (const [key, entity] of this.all) if (entity.component === component && entity.kind === kind && !seen.has(key)) entity.is_seen = false;
    for (const key of this.all.keys()) {
      if (this.all.size <= most_entities) break;
      this.all.delete(key);
    }
    this.pulse.touch();
  }

  // Localization tells nothing when the last one has left: detection does.
  private nobody_there(event: ReceiveEvent): void {
    const engine = this.engine_of(event.component_ref.code);
    for (const entity of this.all.values())
      if (entity.kind !== 'sound' && this.engine_of(entity.component) === engine) entity.is_seen = false;
    this.pulse.touch();
  }

  // Identification names somebody by another code than tracking does; they are the same when they are in the same place.
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
