// People, faces and sound sources, as the events of localization and identification tell them.
import type { ReceiveEvent, Subscription } from 'rois-client';

import type { Environment, Stop } from './environment';
import { Pulse } from './pulse';
import { type Entity, kind_told_by, located_in, placed } from './things';

const most_entities = 500;
const forgotten_after = 30_000; // ms since it was told of
const same_place = 1000; // mm: somebody who is identified there is the one who is tracked there

/** The events that tell of them; the last one tells when there is nobody. */
export const entity_events = ['person_localized', 'face_localized', 'sound_localized', 'person_identified', 'person_detected'];

export class EntitiesState {
  /** By kind and ref: `person person-1`. They change in place: read `pulse.beat.value`, then this. */
  readonly all = new Map<string, Entity>();
  readonly pulse: Pulse;
  private lookers = 0;
  private readonly subscribed = new Map<string, Promise<Subscription | undefined>>();
  private stop_clock: Stop | undefined;

  constructor(
    private readonly environment: Environment,
    private readonly subscribe: (event_type: string) => Promise<Subscription>,
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
    if (kind) this.localized(kind, event);
    else if (event.event_type === 'person_identified') this.identified(event);
    else if (event.event_type === 'person_detected' && event.results.number('number') === 0) this.nobody_there(event);
  }

  forget(): void {
    this.all.clear();
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
