// The Observe switch: starts the detection of persons, faces and sounds, so that the map shows them without another application.
import { effect, signal, untracked } from '@preact/signals';
import { command, RoisError } from 'rois-client';

import type { Console } from '../state/console';
import type { GiveBack } from '../state/session/bindings';

/** Types of components to bind and start, if the engine has them. */
const observing_types = ['PersonDetection', 'PersonLocalization', 'PersonIdentification', 'FaceLocalization', 'SoundLocalization'];

export interface Observing {
  is_wanted: boolean;
  is_busy: boolean; // starting or releasing
  /** Components that are observing. */
  on: readonly string[];
  /** Components that could not be started, with the reason. */
  refused: readonly { ref: string; error: unknown }[];
}

const remembered = 'map.observe'; // restored after a reload

const off: Observing = { is_wanted: false, is_busy: false, on: [], refused: [] };

/** Observes across panel changes and sessions until it is switched off. */
export class Observer {
  readonly state;
  private readonly held = new Map<string, { give_back: GiveBack; was_running: boolean }>();
  private session = '';
  private turn: Promise<void> = Promise.resolve();

  constructor(private readonly console: Console) {
    const { environment } = console;
    this.state = signal<Observing>({ ...off, is_wanted: environment.recall(remembered) === 'on' });
    effect(() => environment.remember(remembered, this.state.value.is_wanted ? 'on' : ''));
    effect(() => {
      const { link, profile } = console;
      const [session, is_open] = [link.session.value, link.is_open];
      void profile.components.value; // also starts components that are new in the profile
      untracked(() => {
        if (session !== this.session) this.forget(session);
        if (is_open && this.state.value.is_wanted) this.next(() => this.take());
      });
    });
    // Forgets components that were released elsewhere.
    effect(() => {
      const mine = console.bindings.mine.value;
      untracked(() => {
        for (const ref of this.held.keys()) if (!mine.has(ref)) this.held.delete(ref);
        const { on, is_busy } = this.state.value;
        const left = on.filter((ref) => mine.has(ref));
        if (left.length < on.length && !is_busy) this.update(left.length > 0 || !console.link.is_open ? { on: left } : off);
      });
    });
    // Restarts stopped components when no command needs them.
    effect(() => {
      void console.commands.pulse.beat.value;
      void console.now.value;
      untracked(() => this.look());
    });
  }

  /** The engine's components to observe with. */
  get components(): string[] {
    return observing_types.flatMap((type) => this.console.profile.of_type(type).map((one) => one.ref));
  }

  /** Resolves when the components are started or released. */
  async turn_to(is_wanted: boolean): Promise<void> {
    this.update({ is_wanted, refused: [] });
    await this.next(() => (this.state.value.is_wanted ? this.take() : this.give_back()));
  }

  private next(act: () => Promise<void>): Promise<void> {
    this.turn = this.turn.then(async () => {
      this.update({ is_busy: true });
      await act();
      this.update({ is_busy: false });
    });
    return this.turn;
  }

  private async take(): Promise<void> {
    const { commands, bindings } = this.console;
    for (const ref of this.components) {
      if (!this.state.value.is_wanted || (this.held.has(ref) && (commands.goes_on(ref) || bindings.lent(ref) !== 1))) continue;
      try {
        await this.start(ref);
        this.update({ on: this.sensing(), refused: this.state.value.refused.filter((one) => one.ref !== ref) });
      } catch (error) {
        // Retried with the next link.
        if (error instanceof RoisError && ['link_lost', 'session_lost', 'closed'].includes(error.failure)) return;
        this.update({ refused: [...this.state.value.refused.filter((one) => one.ref !== ref), { ref, error }] });
      }
    }
  }

  private async start(ref: string): Promise<void> {
    const known = this.held.get(ref);
    const was_running = known?.was_running ?? this.console.commands.goes_on(ref);
    const give_back = known?.give_back ?? (await this.console.bindings.borrow([ref]));
    this.held.set(ref, { give_back, was_running });
    if (this.console.commands.goes_on(ref)) return;
    try {
      const status = await (await this.console.client.execute([command(ref, 'start')])).status();
      if (status !== 'OK') throw new Error(status);
    } catch (error) {
      this.held.delete(ref);
      await give_back();
      throw error;
    }
  }

  private sensing(): string[] {
    return [...this.held.keys()].filter((ref) => this.console.commands.goes_on(ref));
  }

  private look(): void {
    const { commands, bindings, link } = this.console;
    const { is_wanted, is_busy, on } = this.state.value;
    if (!is_wanted || is_busy || !link.is_open) return;
    const sensing = this.sensing();
    if (sensing.length !== on.length) this.update({ on: sensing });
    if ([...this.held.keys()].some((ref) => !commands.goes_on(ref) && bindings.lent(ref) === 1)) void this.next(() => this.take());
  }

  // Releasing stops components bound by Observe. Components bound by the user before are stopped unless they were already working.
  private async give_back(): Promise<void> {
    const { console } = this;
    for (const [ref, { give_back, was_running }] of [...this.held]) {
      this.held.delete(ref);
      await give_back();
      if (!was_running && console.bindings.mine.value.has(ref)) await console.client.execute([command(ref, 'stop')]).catch(() => undefined);
    }
    this.update(this.state.value.is_wanted ? { on: [] } : off);
  }

  private forget(session: string): void {
    this.session = session;
    this.held.clear();
    this.update({ on: [], refused: [] });
  }

  private update(more: Partial<Observing>): void {
    this.state.value = { ...this.state.value, ...more };
  }
}

