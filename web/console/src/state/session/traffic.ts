// Message counts, response times and refusals of the last two minutes, by second.
import type { Environment } from '../base/environment';
import type { Poll } from '../base/poll';
import { Ring } from '../base/ring';
import type { LoggedDocument } from './document_log';
import type { Documents } from './documents';
import type { OwnRequests } from './own_requests';

export interface Second {
  at: number; // begin, ms since 1970
  sent: number; // documents
  received: number;
  tooks: number[]; // ms, of the first answers
  slowest?: LoggedDocument; // the slowest answer
}

const most_seconds = 120;
const most_tooks = 64;
const most_refused = 200;
const most_refused_bytes = 1024 * 1024;

export class Traffic {
  /** Oldest first; seconds without traffic are missing. */
  readonly seconds = new Ring<Second>(most_seconds);
  /** Faults and refusals, except for the console's own requests. */
  readonly refused = new Ring<LoggedDocument>(most_refused, most_refused_bytes, (one) => 2 * one.text.length + 200);
  /** While watched and without other traffic, sends a light request each second to measure the response time. */
  readonly ping: Poll;
  private answered_at = 0;

  constructor(
    private readonly environment: Environment,
    private readonly requests: OwnRequests,
    documents: Documents,
    private readonly period = 1000, // ms
  ) {
    documents.listen((document) => this.on_document(document));
    this.ping = requests.poll(period, () => this.ask());
  }

  /** Adds the refusals of this page before its reload. */
  recall(refused: readonly LoggedDocument[]): void {
    for (const one of refused) this.refused.push(one);
  }

  private on_document(document: LoggedDocument): void {
    const second = this.second_of(document.at);
    if (document.direction === 'out') {
      second.sent += 1;
      return;
    }
    second.received += 1;
    const { took, kind, return_code, is_own } = document;
    if (took !== undefined) {
      this.answered_at = document.at;
      if (second.tooks.length < most_tooks) second.tooks.push(took);
      if (took > (second.slowest?.took ?? -1)) second.slowest = document;
    }
    if (!is_own && (kind === 'fault' || (kind === 'answer' && return_code !== undefined && return_code !== 'OK')))
      this.refused.push(document);
  }

  private second_of(at: number): Second {
    const begun = Math.floor(at / 1000) * 1000;
    const last = this.seconds.at(-1);
    if (last && last.at >= begun) return last; // after the clock was set back
    const second: Second = { at: begun, sent: 0, received: 0, tooks: [] };
    this.seconds.push(second);
    return second;
  }

  // The engine itself answers `search`; queries to components would add load there.
  private async ask(): Promise<void> {
    if (this.environment.now() - this.answered_at < 0.9 * this.period) return;
    await this.requests.send((client) => client.search());
  }
}

/** The median; undefined if empty. */
export function median(numbers: readonly number[]): number | undefined {
  const sorted = [...numbers].sort((a, b) => a - b);
  const half = sorted.length >> 1;
  return sorted.length % 2 === 1 ? sorted[half] : sorted.length === 0 ? undefined : (sorted[half - 1]! + sorted[half]!) / 2;
}
