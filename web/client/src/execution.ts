// Commands on their way, and how they ended.
import { type CompletedStatus, RoisError } from './errors.js';
import type { Completed } from './messages.js';
import { for_timer } from './times.js';

/** How a command ended. */
export class Completion {
  constructor(
    readonly status: CompletedStatus,
    /** Why the status is not OK, as the engine says it; may be empty. */
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

/** Commands that the engine has accepted. */
export class Execution {
  constructor(
    /** In document order. */
    readonly command_ids: string[],
    private readonly ends: Promise<CompletedStatus>[],
    private readonly reason_of: (command_id: string) => Promise<string>,
  ) {}

  /**
   * How each command ended, in the order of `command_ids`. Rejects with `session_lost` when the session was lost before, and with
   * `deadline` when one has not ended within so many ms; it can be asked again then.
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

  /** OK when all of them ended so, else how the first that did not. */
  async status(deadline?: number): Promise<CompletedStatus> {
    return (await this.statuses(deadline)).find((status) => status !== 'OK') ?? 'OK';
  }

  /** The same with the reason, for which the engine is asked when a command failed. */
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

const most_used = 2000; // ids that are remembered; an engine keeps 1,000 of a session

/** The commands of a session that have not ended. */
export class Commands {
  private readonly waiting = new Map<string, Waiting>();
  private readonly used = new Set<string>();

  /** How this command will end. Before it is sent: its end may come before the answer. */
  expect(id: string): Promise<CompletedStatus> {
    const known = this.waiting.get(id);
    if (known) return known.end;
    let resolve!: (status: CompletedStatus) => void;
    let reject!: (error: unknown) => void;
    const end = new Promise<CompletedStatus>((...both) => ([resolve, reject] = both));
    end.catch(() => undefined); // nobody has to wait for it
    this.waiting.set(id, { end, resolve, reject });
    return end;
  }

  /** They were not accepted. */
  forget(ids: string[]): void {
    for (const id of ids) this.waiting.delete(id);
  }

  /** They were accepted: their names are used up for this session. */
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

  /** The session is gone, and their ends with it. */
  fail(error: RoisError): void {
    for (const one of this.waiting.values()) one.reject(error);
    this.waiting.clear();
    this.used.clear();
  }
}
