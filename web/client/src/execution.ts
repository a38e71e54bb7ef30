// Running commands and how they end.
import { type CompletedStatus, RoisError } from './errors.js';
import type { Completed } from './messages.js';
import { for_timer } from './times.js';

/** The end of a command. */
export class Completion {
  constructor(
    readonly status: CompletedStatus,
    /** The engine's reason for a status other than OK; may be empty. */
    readonly reason = '',
  ) {}

  get ok(): boolean {
    return this.status === 'OK';
  }

  /** `OK`, or the status and the reason: `ERROR: no way leads to the target`. */
  toString(): string {
    return this.reason === '' ? this.status : `${this.status}: ${this.reason}`;
  }
}

/** Accepted commands. */
export class Execution {
  constructor(
    /** In document order. */
    readonly command_ids: string[],
    private readonly ends: Promise<CompletedStatus>[],
    private readonly reason_of: (command_id: string) => Promise<string>,
  ) {}

  /**
   * Resolves with the statuses in the order of `command_ids`. Rejects with `session_lost` if the session is lost first, and with
   * `deadline` after `deadline` ms; it may then be called again.
   */
  async statuses(deadline?: number): Promise<CompletedStatus[]> {
    const all = Promise.all(this.ends);
    if (deadline === undefined) return all;
    let timer: ReturnType<typeof setTimeout> | undefined;
    const late = new Promise<never>((_, reject) => {
      timer = setTimeout(() => reject(new RoisError('deadline', `not completed within ${deadline} ms`)), for_timer(deadline));
    });
    return Promise.race([all, late]).finally(() => clearTimeout(timer));
  }

  /** Resolves with OK, or with the first status that is not OK. Rejects as `statuses`. */
  async status(deadline?: number): Promise<CompletedStatus> {
    return (await this.statuses(deadline)).find((status) => status !== 'OK') ?? 'OK';
  }

  /** As `status`, with the reason of the failed command, which it fetches from the engine. */
  async completion(deadline?: number): Promise<Completion> {
    const statuses = await this.statuses(deadline);
    const failed = statuses.findIndex((status) => status !== 'OK');
    return failed < 0 ? new Completion('OK') : new Completion(statuses[failed]!, await this.reason_of(this.command_ids[failed]!));
  }
}

interface Waiting {
  end: Promise<CompletedStatus>;
  resolve(status: CompletedStatus): void;
  reject(error: unknown): void;
}

const most_used = 2000; // command ids remembered; an engine keeps 1,000 for a session

/** The running commands of a session. */
export class Commands {
  private readonly waiting = new Map<string, Waiting>();
  private readonly used = new Set<string>();

  /** Returns the promise of this command's end. Call it before sending: the end may arrive before the answer. */
  expect(id: string): Promise<CompletedStatus> {
    const known = this.waiting.get(id);
    if (known) return known.end;
    let resolve!: (status: CompletedStatus) => void;
    let reject!: (error: unknown) => void;
    const end = new Promise<CompletedStatus>((...both) => ([resolve, reject] = both));
    end.catch(() => undefined); // the caller may ignore it
    this.waiting.set(id, { end, resolve, reject });
    return end;
  }

  /** The engine rejected these commands. */
  forget(ids: string[]): void {
    for (const id of ids) this.waiting.delete(id);
  }

  /** The engine accepted these commands: their ids cannot be used again in this session. */
  use(ids: string[]): void {
    for (const id of ids) this.used.add(id);
    for (const id of this.used) {
      if (this.used.size <= most_used) return;
      this.used.delete(id);
    }
  }

  is_used(id: string): boolean {
    return this.used.has(id);
  }

  completed({ command_id, status }: Completed): void {
    this.waiting.get(command_id)?.resolve(status);
    this.waiting.delete(command_id);
  }

  /** The session is lost: rejects all. */
  fail(error: RoisError): void {
    for (const one of this.waiting.values()) one.reject(error);
    this.waiting.clear();
    this.used.clear();
  }
}
