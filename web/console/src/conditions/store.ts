// The condition of a console, kept across panel changes and visits.
import { computed, type ReadonlySignal, signal } from '@preact/signals';
import type { Condition, Subscription } from 'rois-client';

import type { Console } from '../state/console';
import { LiveMatches } from './matches';
import { type Draft, draft_of, draft_text, type Group, new_draft } from './model';
import { type Known, type Reference, references_of } from './vocabulary';

export class ConditionStore {
  readonly draft = signal<Draft>(new_draft());
  readonly references: ReadonlySignal<readonly Reference[]>;
  readonly known: ReadonlySignal<Known>;
  readonly matches: LiveMatches;
  /** Subscriptions made here, newest first. */
  readonly subscribed = signal<readonly Subscription[]>([]);

  constructor(private readonly console: Console) {
    this.draft.value = draft_of(console.environment.recall('condition')) ?? new_draft();
    this.matches = new LiveMatches(console);
    this.known = computed(() => known_to(console));
    this.references = computed(() => references_of(this.known.value, this.draft.value));
  }

  change(to: Partial<Draft>): void {
    this.draft.value = { ...this.draft.value, ...to };
    this.console.environment.remember('condition', draft_text(this.draft.value));
  }

  change_root(change: (root: Group) => Group): void {
    this.change({ root: change(this.draft.value.root) });
  }

  async subscribe(event_type: string, condition: Condition, inline_results: boolean): Promise<void> {
    const options = condition.xml === '' ? { inline_results } : { condition, inline_results };
    this.subscribed.value = [await this.console.subscribe(event_type, options), ...this.subscribed.value];
  }

  async unsubscribe(subscription: Subscription): Promise<void> {
    this.subscribed.value = this.subscribed.value.filter((one) => one !== subscription);
    await subscription.close().catch(() => undefined);
  }
}

const stores = new WeakMap<Console, ConditionStore>();

export function store_of(console: Console): ConditionStore {
  const store = stores.get(console) ?? new ConditionStore(console);
  stores.set(console, store);
  return store;
}

function known_to({ profile, map, robots, entities }: Console): Known {
  const components = profile.components.value;
  const view = map.view.value;
  const floor_map = view.state === 'there' ? view.map : undefined;
  return {
    components,
    engines: [...new Set(components.map((one) => one.engine))],
    robots: { [Symbol.iterator]: () => robots.all.values() },
    entities: { [Symbol.iterator]: () => entities.all.values() },
    places: floor_map ? [floor_map.name, ...floor_map.places.map((one) => one.name)].filter((one) => one !== '') : [],
  };
}
