// The latest documents by number. The console's own polls and subscriptions have a separate limit, so that they do not displace the
// user's documents.
import { Ring } from '../base/ring';

export type Direction = 'in' | 'out';

/** Kind of a document; the direction alone does not determine it. */
export type DocumentKind = 'request' | 'answer' | 'fault' | 'notification';

export interface LoggedDocument {
  number: number; // from 0, in order of arrival
  at: number; // ms since 1970
  direction: Direction;
  kind: DocumentKind;
  name: string; // of the root: `bind`, `bind_response`, `receive_event`, `fault`; empty if there is none
  text: string;
  component?: string; // the first component_ref in it
  sequence?: number; // of a notification
  return_code?: string; // of an answer
  request?: LoggedDocument; // of an answer: its request
  took?: number; // of an answer: ms since the request, with fractions
  is_own: boolean; // sent by the console for its own display: hidden by default
}

export interface DocumentLimits {
  most: number;
  most_bytes: number;
}

const share_of_polls = 0.1; // of both limits, in addition to them
const polls = /^((query|search|get_command_result)(_response)?|receive_event)$/;

const number_of = (one: LoggedDocument) => one.number;

/** Numbers only increase. Forgotten documents are missing, also between others. */
export class DocumentLog implements Iterable<LoggedDocument> {
  private readonly kept: Ring<LoggedDocument>;
  private readonly polled: Ring<LoggedDocument>;
  private next = 0;

  constructor({ most, most_bytes }: DocumentLimits) {
    // A UTF-16 text takes up to two bytes a unit.
    const weigh = ({ text }: LoggedDocument) => 2 * text.length + 200;
    this.kept = new Ring(most, most_bytes, weigh);
    this.polled = new Ring(Math.ceil(most * share_of_polls), most_bytes * share_of_polls, weigh);
  }

  push(document: LoggedDocument): void {
    this.next = document.number + 1;
    (document.is_own && polls.test(document.name) ? this.polled : this.kept).push(document);
  }

  /** Number of stored documents. */
  get size(): number {
    return this.kept.size + this.polled.size;
  }
  get bytes(): number {
    return this.kept.bytes + this.polled.bytes;
  }
  /** The number of the oldest stored document. */
  get first(): number {
    return Math.min(this.kept.at(0)?.number ?? this.next, this.polled.at(0)?.number ?? this.next);
  }
  /** The number of the next document. */
  get end(): number {
    return this.next;
  }
  get last(): LoggedDocument | undefined {
    return this.numbered(this.next - 1);
  }
  numbered(number: number): LoggedDocument | undefined {
    return this.kept.find(number, number_of) ?? this.polled.find(number, number_of);
  }
  list(): LoggedDocument[] {
    return [...this];
  }
  *[Symbol.iterator](): Iterator<LoggedDocument> {
    let [i, j] = [0, 0];
    for (;;) {
      const [one, other] = [this.kept.at(i), this.polled.at(j)];
      if (!one && !other) return;
      if (!other || (one && one.number < other.number)) {
        yield one!;
        i += 1;
      } else {
        yield other;
        j += 1;
      }
    }
  }
}
