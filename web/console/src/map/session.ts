// State of the map, kept while another panel is shown: view, selection, Observe.
import { effect, signal, untracked } from '@preact/signals';

import type { Console } from '../state/console';
import type { FloorMap } from '../state/floor/floor_map';
import { type Driver, drivers_of } from './driving';
import { at_rest, type Interaction } from './interaction';
import { Observer } from './observer';
import { all_layers, type Layers } from './painting/ground';
import { type Scene, scene_of } from './scene';

export class MapSession {
  readonly interaction = signal<Interaction>(at_rest);
  readonly hovered = signal<string | undefined>(undefined);
  /** Engine of the robot to send; empty: the first one. */
  readonly engine = signal('');
  readonly layers = signal<Layers>(all_layers);
  readonly shows_table = signal(false);
  /** Time limit and distance for the next commands, as typed. */
  readonly time_limit = signal('120'); // s; empty: none
  readonly gap = signal('1.0'); // m
  readonly observer: Observer;

  constructor(private readonly console: Console) {
    this.observer = new Observer(console);
    const hidden = new Set((console.environment.recall('map.hidden') ?? '').split(' '));
    this.layers.value = Object.fromEntries(Object.keys(all_layers).map((name) => [name, !hidden.has(name)])) as unknown as Layers;
    this.shows_table.value = console.environment.recall('map.table') === 'shown';
    // Selecting a robot also makes it the one to send.
    effect(() => {
      const { chosen } = this.interaction.value;
      const driver = untracked(() => this.drivers().find(({ robot }) => robot !== undefined && `robot ${robot.ref}` === chosen));
      if (driver) this.engine.value = driver.engine;
    });
  }

  get map(): FloorMap | undefined {
    const view = this.console.map.view.value;
    return view.state === 'there' ? view.map : undefined;
  }

  /** The present scene. */
  scene(): Scene {
    const { robots, entities, environment, link, bindings, commands, status, members } = this.console;
    return scene_of({
      robots: robots.all.values(),
      entities: entities.all.values(),
      map: this.map,
      now: environment.now(),
      is_live: link.is_open,
      senses: (ref) => (bindings.mine.value.has(ref) ? commands.goes_on(ref) : status.of(ref)?.status !== 'READY'),
      acts_for: (ref) => members.acts_for(ref),
    });
  }

  drivers(): Driver[] {
    void this.console.robots.pulse.beat.value;
    return drivers_of(this.console);
  }

  /** The robot to send. */
  driver(): Driver | undefined {
    const all = this.drivers();
    return all.find((one) => one.engine === this.engine.value) ?? all[0];
  }

  show(layer: keyof Layers, is_shown: boolean): void {
    this.layers.value = { ...this.layers.value, [layer]: is_shown };
    const hidden = Object.entries(this.layers.value).filter(([, shown]) => !shown);
    this.console.environment.remember('map.hidden', hidden.map(([name]) => name).join(' '));
  }

  show_table(is_shown: boolean): void {
    this.shows_table.value = is_shown;
    this.console.environment.remember('map.table', is_shown ? 'shown' : 'hidden');
  }
}

const sessions = new WeakMap<Console, MapSession>();

export function session_of(console: Console): MapSession {
  const known = sessions.get(console) ?? new MapSession(console);
  sessions.set(console, known);
  return known;
}
