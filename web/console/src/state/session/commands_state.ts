// The commands of this session: waiting, running or ended.
import { type Client, code_of, type CommandUnit, type CompletedStatus, type Parameter, parse_xml, type Results } from 'rois-client';

import type { Environment, Stop } from '../base/environment';
import { Pulse } from '../base/pulse';
import { Ring } from '../base/ring';
import type { LoggedDocument } from './document_log';
import type { Documents } from './documents';
import { placed_commands, units_of } from './sequences';

/** `unknown`: the session was lost before the command ended. */
export type CommandState = 'waiting' | 'running' | CompletedStatus | 'unknown';

export interface CommandEntry {
  id: string;
  component: string;
  command_type: string;
  arguments: Parameter[];
  path: string; // place in its sequence
  sequence: SequenceEntry;
  state: CommandState;
  sent_at: number; // ms since 1970, as all times
  started_at?: number; // when the console noticed that it runs
  ended_at?: number;
  completed?: number; // number of the `completed` document
  results?: Results; // fetched by `fetch_results`, and automatically after a failure
}

/** An accepted `execute` or `set_parameter`. */
export interface SequenceEntry {
  number: number;
  units: CommandUnit[];
  commands: CommandEntry[];
  sent_at: number;
  document: number; // number of the request
}

const most_commands = 5000;
const look_every = 400; // ms, period of checking waiting commands
const most_asked = 16; // per check

export function has_ended({ state }: CommandEntry): boolean {
  return state !== 'waiting' && state !== 'running';
}

export class CommandsState {
  /** The newest is last. */
  readonly all: Ring<CommandEntry>;
  readonly pulse: Pulse;
  private readonly by_id = new Map<string, CommandEntry>();
  private readonly unended = new Set<CommandEntry>();
  private readonly working = new Set<string>();
  private readonly early = new Map<string, CompletedStatus>(); // ended before their answer was processed
  private next_sequence = 1;
  private stop_looking: Stop | undefined;

  constructor(
    private readonly environment: Environment,
    private readonly documents: Documents,
    private readonly client: () => Client | undefined,
    private readonly lasts: (ref: string) => boolean,
  ) {
    this.all = new Ring(most_commands);
    this.pulse = new Pulse(environment);
  }

  find(id: string): CommandEntry | undefined {
    return this.by_id.get(id);
  }

  /** Commands that have not ended, oldest first. */
  open(): CommandEntry[] {
    return [...this.unended];
  }

  /** This session's running commands on a component. */
  running_on(ref: string): CommandEntry[] {
    return this.open().filter((one) => one.component === ref && one.state === 'running');
  }

  /** Whether a component was started and keeps working after `start` has completed, until it is stopped or released. */
  goes_on(ref: string): boolean {
    return this.working.has(ref) && this.lasts(ref);
  }

  /** Updates from an answer, whether the user or the console sent the request. */
  on_answer({ name, return_code, text, request }: LoggedDocument): void {
    if (return_code !== 'OK' || request === undefined) return;
    if (name === 'release_response') this.working.delete(request.component ?? '');
    if (name === 'execute_response') this.accepted(units_of(parse_xml(text)), request);
    if (name === 'set_parameter_response') this.accepted([setting(parse_xml(text).text_of('command_id'), request)], request);
  }

  ended(id: string, status: CompletedStatus, document?: number): void {
    const entry = this.by_id.get(id);
    if (!entry) {
      this.early.set(id, status);
      if (this.early.size > most_asked) this.early.delete(this.early.keys().next().value!);
      return;
    }
    if (document !== undefined) entry.completed = document;
    this.end(entry, status);
    this.look();
    if (status !== 'OK') void this.fetch_results(entry);
  }

  /** The session is lost: its commands were stopped, but how they ended is unknown. */
  forget_session(): void {
    for (const entry of [...this.unended]) this.end(entry, 'unknown');
    this.by_id.clear();
    this.working.clear();
  }

  /** Adds the commands of this page before its reload. Unfinished commands become `unknown`. */
  recall(entries: readonly CommandEntry[]): void {
    for (const entry of entries) {
      const sequence: SequenceEntry = { number: this.next_sequence++, units: [], commands: [], sent_at: entry.sent_at, document: -1 };
      const ended = has_ended(entry) ? {} : { state: 'unknown' as const, ended_at: this.environment.now() };
      delete entry.completed;
      sequence.commands.push({ ...entry, ...ended, sequence });
      this.all.push(sequence.commands[0]!);
    }
    this.pulse.touch();
  }

  async fetch_results(entry: CommandEntry): Promise<Results | undefined> {
    const client = this.client();
    if (!client || entry.results) return entry.results;
    const results = await this.documents.as_own(() => client.get_command_result(entry.id)).catch(() => undefined);
    if (results) entry.results = results;
    this.pulse.touch();
    return results;
  }

  private accepted(units: CommandUnit[], request: LoggedDocument): void {
    const sequence: SequenceEntry = { number: this.next_sequence++, units, commands: [], sent_at: request.at, document: request.number };
    for (const { path, command } of placed_commands(units)) {
      const entry: CommandEntry = {
        id: command.command_id,
        component: code_of(command.component_ref),
        command_type: command.command_type,
        arguments: command.arguments,
        path,
        sequence,
        state: 'waiting',
        sent_at: request.at,
      };
      sequence.commands.push(entry);
      this.add(entry);
    }
    this.look();
  }

  private add(entry: CommandEntry): void {
    if (this.all.size === most_commands) {
      const oldest = this.all.at(0)!;
      this.unended.delete(oldest);
      if (this.by_id.get(oldest.id) === oldest) this.by_id.delete(oldest.id);
    }
    this.all.push(entry);
    this.by_id.set(entry.id, entry);
    this.unended.add(entry);
    const status = this.early.get(entry.id);
    this.early.delete(entry.id);
    if (status) this.end(entry, status);
    this.pulse.touch();
  }

  private end(entry: CommandEntry, state: CommandState): void {
    entry.state = state;
    if (state === 'OK' && /^(start|resume)$/.test(entry.command_type)) this.working.add(entry.component);
    if (state === 'OK' && /^(stop|suspend)$/.test(entry.command_type)) this.working.delete(entry.component);
    entry.ended_at = this.environment.now();
    this.unended.delete(entry);
    this.pulse.touch();
  }

  // Checks waiting commands: the engine notifies the end of a command, but not its start.
  private look(): void {
    this.stop_looking?.();
    this.stop_looking = undefined;
    const client = this.client();
    const waiting = this.open().filter((one) => one.state === 'waiting').slice(0, most_asked);
    if (!client || waiting.length === 0) return;
    for (const entry of waiting)
      this.documents
        .as_own(() => client.get_command_result(entry.id))
        .then(
          (results) => {
            if (results.text('status') === 'RUNNING' && entry.state === 'waiting') this.began(entry);
          },
          () => undefined,
        );
    this.stop_looking = this.environment.after(look_every, () => this.look());
  }

  private began(entry: CommandEntry): void {
    entry.state = 'running';
    entry.started_at = this.environment.now();
    this.pulse.touch();
  }
}

// A set_parameter as a command.
function setting(command_id: string, request: LoggedDocument): CommandUnit {
  return { kind: 'command', component_ref: request.component ?? '', command_type: 'set_parameter', command_id, arguments: [] };
}
