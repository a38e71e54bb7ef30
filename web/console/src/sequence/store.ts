// The edited sequence, the stored ones and the shown run. Kept while another panel is shown.
import { computed, signal } from '@preact/signals';
import { type CommandUnit, type Parameter, parse_xml, request, RoisError, sequence_xml } from 'rois-client';

import { arguments_in } from '../forms/argument_fields';
import { asked_by, same } from '../forms/describe';
import type { Console } from '../state/console';
import { type CommandEntry, has_ended } from '../state/session/commands_state';
import { placed_commands, units_of } from '../state/session/sequences';
import { problems_in_sequence, type Profiles } from './checking';
import { draft_of, draft_text } from './draft';
import { drop_sequence, keep_sequence, kept_sequences } from './library';
import { type CommandStep, commands_in, type Lane, new_lane } from './model';
import { lane_of, units_of_lane } from './units';

/** A sent sequence and its outcome. */
export interface Run {
  sent_at: number;
  root: Lane;
  /** By step id; empty until the engine has accepted it. */
  entries: ReadonlyMap<number, CommandEntry>;
  /** Components bound for the run and released at its end. */
  borrowed: readonly string[];
  /** Stopped by the user: waiting commands will not run. */
  is_stopped?: boolean;
  /** Why it was refused. */
  error?: unknown;
  /** The step that the refusal names. */
  refused_step?: number;
}

const most_undone = 50;

export class SequenceStore {
  readonly root = signal<Lane>(new_lane());
  readonly name = signal('');
  /** The selected step; 0: none. */
  readonly chosen = signal(0);
  readonly kept = signal<ReadonlyMap<string, string>>(new Map());
  readonly run = signal<Run | undefined>(undefined);
  /** Whether missing values are shown as problems: after the first attempt to run. */
  readonly is_strict = signal(false);
  readonly problems = computed(() => problems_in_sequence(this.root.value, this.profiles));
  readonly can_undo = signal(false);
  private readonly past: Lane[] = [];
  private left_queued: CommandEntry[] = []; // delayed commands that were waiting when their run was stopped

  constructor(private readonly console: Console) {
    this.root.value = draft_of(console.environment.recall('sequence')) ?? new_lane();
    this.name.value = console.environment.recall('sequence.name') ?? '';
    this.kept.value = kept_sequences(console.environment);
  }

  // --- Editing ---

  change(root: Lane): void {
    if (root === this.root.value) return;
    this.past.push(this.root.value);
    if (this.past.length > most_undone) this.past.shift();
    this.put(root);
  }

  undo(): void {
    const before = this.past.pop();
    if (before) this.put(before);
  }

  private put(root: Lane): void {
    this.root.value = root;
    this.can_undo.value = this.past.length > 0;
    this.console.environment.remember('sequence', draft_text(root));
  }

  /** Replaces the sequence and drops the shown run. */
  open(name: string, root: Lane): void {
    this.change(root);
    this.rename(name);
    this.chosen.value = 0;
    this.is_strict.value = false;
    if (!this.is_running) this.run.value = undefined;
  }

  rename(name: string): void {
    this.name.value = name;
    this.console.environment.remember('sequence.name', name);
  }

  // --- XML ---

  get units(): CommandUnit[] {
    return units_of_lane(this.root.value, this.arguments_of);
  }

  /** The request that would be sent; empty if XML does not allow one of its characters. */
  get request(): string {
    return written(() => request('execute', {}, sequence_xml(this.units)));
  }

  /** The sequence as a document. */
  get document(): string {
    const xml = parse_and_cut(this.request);
    return xml === '' ? '' : `<?xml version="1.0" encoding="UTF-8"?>\n${xml}\n`;
  }

  /** Throws XmlError if it is not XML, and Error if it has no sequence. */
  read(text: string): Lane {
    const units = units_of(parse_xml(text));
    if (units.length === 0) throw new Error('no CommandUnitSequence');
    return lane_of(units, (ref, type, name) => {
      const view = this.console.profile.component(ref);
      return view ? asked_by(view, type).some((one) => same(one.name, name)) : this.console.profile.profile.value === undefined;
    });
  }

  private readonly arguments_of = (step: CommandStep): Parameter[] => {
    const view = this.console.profile.component(step.component);
    return view ? arguments_in(this.console, view.ref, asked_by(view, step.command_type), step.inputs) : [];
  };

  private get profiles(): Profiles {
    const { profile, parameters } = this.console;
    return {
      component: (ref) => profile.component(ref),
      has_value: (ref, name) => (parameters.of(ref)?.texts(name).length ?? 0) > 0,
    };
  }

  // --- Storage ---

  keep(): void {
    const name = this.name.value.trim();
    if (name !== '' && this.document !== '') this.kept.value = keep_sequence(this.console.environment, name, this.document);
  }

  drop(name: string): void {
    this.kept.value = drop_sequence(this.console.environment, name);
  }

  // --- Running ---

  get is_empty(): boolean {
    return this.problems.value[0]?.what === 'nothing';
  }

  get is_running(): boolean {
    void this.console.commands.pulse.beat.value;
    return this.open_entries().some((one) => one.state === 'running' || !this.run.value?.is_stopped);
  }

  /**
   * Components with a queued command of a stopped run. The engine checks the binding when the command's turn comes, so it would run if
   * the component were bound again before.
   */
  get still_queued(): string[] {
    void this.console.commands.pulse.beat.value;
    const refs = new Set(this.left_queued.filter((one) => !has_ended(one)).map((one) => one.component));
    return [...new Set(commands_in(this.root.value).map((one) => one.component))].filter((ref) => refs.has(ref));
  }

  private open_entries(): CommandEntry[] {
    return [...(this.run.value?.entries.values() ?? [])].filter((one) => !has_ended(one));
  }

  /** Components that keep working after `start`: they stay bound. */
  get going_on(): string[] {
    const starts = commands_in(this.root.value).filter((one) => same(one.command_type, 'start')).map((one) => one.component);
    return [...new Set(starts)].filter((ref) => this.console.profile.lasts(ref));
  }

  async execute(): Promise<void> {
    const root = this.root.value;
    const { units } = this;
    const steps = commands_in(root).map((one) => one.id);
    const sent_at = this.console.environment.now();
    const give_back = this.going_on.length === 0;
    const mine = this.console.bindings.mine.value;
    const borrowed = give_back ? [...new Set(commands_in(root).map((one) => one.component))].filter((ref) => !mine.has(ref)) : [];
    try {
      const { command_ids } = await this.console.execute(units, { give_back });
      const found = command_ids.map((id, i) => [steps[i], this.console.commands.find(id)] as const);
      const entries = new Map(found.filter((one): one is [number, CommandEntry] => one[0] !== undefined && one[1] !== undefined));
      this.run.value = { sent_at, root, entries, borrowed };
    } catch (error) {
      const refused_step = step_named_by(error, units, steps);
      this.run.value = { sent_at, root, entries: new Map(), borrowed: [], error, ...(refused_step !== undefined && { refused_step }) };
      if (refused_step !== undefined) this.chosen.value = refused_step;
      throw error;
    }
  }

  /** Stops running commands and those queued behind them. A command that waits for its delay is aborted at its turn, because its
      component is released. */
  async stop(): Promise<void> {
    const open = () => [...new Set(this.open_entries().map((one) => one.component))];
    await Promise.all(open().map(async (ref) => (await this.console.run(ref, 'stop')).ends.catch(() => undefined)));
    this.left_queued = [...this.left_queued, ...this.open_entries()].filter((one) => !has_ended(one));
    const waiting = open();
    // If no command waits, borrowed components are released by themselves.
    const done_with = waiting.length === 0 ? [] : [...new Set([...waiting, ...(this.run.value?.borrowed ?? [])])];
    for (const ref of done_with) if (this.console.bindings.mine.value.has(ref)) await this.console.bindings.release(ref);
    if (this.run.value) this.run.value = { ...this.run.value, is_stopped: true };
  }
}

// The engine names a unit by its path.
function step_named_by(error: unknown, units: readonly CommandUnit[], steps: readonly number[]): number | undefined {
  const path = error instanceof RoisError ? /command_unit_list\[\d+\](?:\/\w+\[\d+\])*/.exec(error.message)?.[0] : undefined;
  const index = placed_commands(units).findIndex((one) => one.path === path);
  return index < 0 ? undefined : steps[index];
}

function written(make: () => string): string {
  try {
    return make();
  } catch {
    return '';
  }
}

// Cuts the element out of the request and declares its prefixes.
function parse_and_cut(text: string): string {
  const [, declared = '', inside = ''] = /^<execute((?:\s[^<>]*)?)>([^]*)<\/execute>$/.exec(text) ?? [];
  const prefixes = [...declared.matchAll(/\sxmlns:\w+="[^"]*"/g)].map(([one]) => one).join('');
  return inside.replace(/^<rois:CommandUnitSequence/, `<rois:CommandUnitSequence${prefixes}`);
}

const stores = new WeakMap<Console, SequenceStore>();

export function store_of(console: Console): SequenceStore {
  const store = stores.get(console) ?? new SequenceStore(console);
  stores.set(console, store);
  return store;
}
