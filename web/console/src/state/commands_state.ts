// The commands of this session: what was sent, what of it waits, runs, or has ended how.
import { type Client, code_of, type CommandUnit, type CompletedStatus, type Parameter, parse_xml, type Results } from 'rois-client';

import type { Documents, LoggedDocument } from './documents';
import type { Environment, Stop } from './environment';
import { Pulse } from './pulse';
import { Ring } from './ring';
import { placed_commands, units_of } from './sequences';

/** `unknown`: the session was lost before it ended. */
export type CommandState = 'waiting' | 'running' | CompletedStatus | 'unknown';

export interface CommandEntry {
  id: string;
  component: string;
  command_type: string;
  arguments: Parameter[];
  path: string; // where it stands in its sequence
  sequence: SequenceEntry;
  state: CommandState;
  sent_at: number; // ms since 1970, as all times
  started_at?: number; // when we have seen that it runs
  ended_at?: number;
  completed?: number; // of the document that told how it ended
  results?: Results; // fetched when somebody asks (`fetch_results`), and by itself when it has failed
}

/** One `execute` or `set_parameter` that was accepted. */
export interface SequenceEntry {
  number: number;
  units: CommandUnit[];
  commands: CommandEntry[];
  sent_at: number;
  document: number; // of the request
}

const most_commands = 5000;
const look_every = 400; // ms, at those that wait
const most_asked = 16; // at once

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
  private readonly early = new Map<string, CompletedStatus>(); // ended before their answer was read
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

  /** Those that have not ended, the oldest first. */
  open(): CommandEntry[] {
    return [...this.unended];
  }

  /** What a component is doing for this session. */
  running_on(ref: string): CommandEntry[] {
    return this.open().filter((one) => one.component === ref && one.state === 'running');
  }

  /** Whether it was started, and neither stopped nor released since, and its work goes on when `start` has completed. */
  goes_on(ref: string): boolean {
    return this.working.has(ref) && this.lasts(ref);
  }

  /** Learns from the answers, whoever has sent the requests. */
  heard({ name, return_code, text, request }: LoggedDocument): void {
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

  /** The session is gone. Its commands were stopped, but nobody says how they ended. */
  forget_session(): void {
    for (const entry of [...this.unended]) this.end(entry, 'unknown');
    this.by_id.clear();
    this.working.clear();
  }

  /** Takes commands of the page that was here before. Those that had not ended then are over, and nobody says how. */
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

  // Asks how those are that wait: the engine tells when a command ends, but not when it begins.
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

// What a set_parameter does, as the command that it is.
function setting(command_id: string, request: LoggedDocument): CommandUnit {
  return { kind: 'command', component_ref: request.component ?? '', command_type: 'set_parameter', command_id, arguments: [] };
}
