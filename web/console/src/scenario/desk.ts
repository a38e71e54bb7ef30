// The open scenario, its changes and its run. One for each console, kept while another panel is shown.
import { computed, signal } from '@preact/signals';

import reception from '../../../../client-cpp/scenarios/reception.xml?raw';
import { Pulse } from '../state/base/pulse';
import { Ring } from '../state/base/ring';
import type { Console } from '../state/console';
import { Machine, type Outcome } from './machine';
import type { Scenario, State, Trigger } from './model';
import { read_scenario } from './read';
import { plain_lines } from './source';

export type HistoryEntry = { number: number; at: number } & HistoryNote;
type HistoryNote = { kind: 'transition'; from: string; to: string; by: string } | { kind: 'print'; line: string };

/** A run. It changes in place: read `pulse.beat.value` first. */
export interface Run {
  began_at: number;
  ended_at?: number;
  outcome?: Outcome;
  /** Empty before the first state, while components are bound. */
  state: string;
  entered_at: number;
  is_leaving: boolean;
  /** Paths of elements in the running text. */
  last_trigger: string;
  /** Number of transitions. */
  taken: number;
  visits: Map<string, number>;
  variables: ReadonlyMap<string, readonly string[]>;
  changed: Map<string, number>; // time of a variable's last change
}

const most_history = 1000;
const most_undo = 100;
const shipped_name = 'reception.xml';

export class Desk {
  readonly text = signal('');
  readonly file_name = signal(shipped_name);
  readonly reading = computed(() => read_scenario(this.text.value));
  /** The last valid scenario, for the diagram. */
  readonly drawn = signal<Scenario | undefined>(undefined);
  /** Whether the diagram is scaled to fit. */
  readonly shows_whole = signal(false);
  /** The selected state; empty: the scenario itself. */
  readonly chosen = signal('');
  readonly history = new Ring<HistoryEntry>(most_history);
  readonly pulse: Pulse;
  readonly can_undo = signal(false);
  run: Run | undefined;
  private undone: { text: string; key: string }[] = [];
  private machine: Machine | undefined;
  private next_number = 1;

  constructor(private readonly console: Console) {
    this.pulse = new Pulse(console.environment);
    const { environment } = console;
    this.put(environment.recall('scenario') ?? plain_lines(reception));
    this.file_name.value = environment.recall('scenario.name') ?? shipped_name;
  }

  get is_running() {
    return this.console.runs_scenario;
  }

  get is_as_shipped(): boolean {
    return this.text.value === plain_lines(reception);
  }

  // --- Text ---

  open(name: string, text: string): void {
    if (this.is_running.value) return;
    this.edit(plain_lines(text), '');
    this.file_name.value = name;
    this.run = undefined;
    this.history.clear();
    this.chosen.value = '';
    this.pulse.touch();
    this.console.environment.remember('scenario.name', name);
  }

  open_shipped(): void {
    this.open(shipped_name, reception);
  }

  /** Successive changes with one key are undone together. */
  edit(text: string, key: string): void {
    if (this.is_running.value || text === this.text.value) return;
    if (this.undone.at(-1)?.key !== key || key === '') this.undone.push({ text: this.text.value, key });
    if (this.undone.length > most_undo) this.undone.shift();
    this.put(text);
  }

  undo(): void {
    const last = this.is_running.value ? undefined : this.undone.pop();
    if (last) this.put(last.text);
  }

  private put(text: string): void {
    this.text.value = text;
    this.drawn.value = this.reading.value.scenario ?? this.drawn.value;
    this.can_undo.value = this.undone.length > 0;
    this.console.environment.remember('scenario', text);
  }

  // --- Running ---

  async start(): Promise<void> {
    const { scenario } = this.reading.value;
    if (!scenario || this.is_running.value) return;
    const { environment } = this.console;
    const run: Run = {
      began_at: environment.now(),
      state: '',
      entered_at: environment.now(),
      is_leaving: false,
      last_trigger: '',
      taken: 0,
      visits: new Map(),
      variables: new Map(),
      changed: new Map(),
    };
    this.run = run;
    this.is_running.value = true;
    this.history.clear();
    this.machine = new Machine(this.console, scenario, {
      entered: (state) => this.entered(run, state),
      leaving: (_, trigger) => this.leaving(run, trigger),
      left: (from, trigger, by) => this.left(run, from, trigger, by),
      printed: (line) => this.note({ kind: 'print', line }),
      variables: ({ all }) => this.changed(run, all),
    });
    this.changed(run, this.machine.variables.all);
    run.changed.clear();
    run.outcome = await this.machine.run();
    run.ended_at = environment.now();
    this.machine = undefined;
    this.is_running.value = false;
    this.pulse.touch();
  }

  stop(): void {
    this.machine?.stop();
  }

  private entered(run: Run, { name }: State): void {
    run.state = name;
    run.entered_at = this.console.environment.now();
    run.is_leaving = false;
    run.visits.set(name, (run.visits.get(name) ?? 0) + 1);
    this.pulse.touch();
  }

  private leaving(run: Run, trigger: Trigger): void {
    run.is_leaving = true;
    run.last_trigger = trigger.node.path;
    this.pulse.touch();
  }

  private left(run: Run, from: State, trigger: Trigger, by: string): void {
    run.last_trigger = trigger.node.path;
    run.taken += 1;
    this.note({ kind: 'transition', from: from.name, to: trigger.to, by });
  }

  private changed(run: Run, variables: ReadonlyMap<string, readonly string[]>): void {
    for (const [name, values] of variables) if (run.variables.get(name) !== values) run.changed.set(name, this.console.environment.now());
    run.variables = new Map(variables);
    this.pulse.touch();
  }

  private note(what: HistoryNote): void {
    this.history.push({ number: this.next_number++, at: this.console.environment.now(), ...what });
    this.pulse.touch();
  }
}

const desks = new WeakMap<Console, Desk>();

export function desk_of(console: Console): Desk {
  const desk = desks.get(console) ?? new Desk(console);
  desks.set(console, desk);
  return desk;
}
