// The last documents, by number. What the console asks again and again by itself, and what it listens for, has a bound of its own, so that it
// does not push out the rest.
import type { LoggedDocument } from './documents';
import { Ring } from './ring';

export interface DocumentLimits {
  most: number;
  most_bytes: number;
}

const share_of_polls = 0.1; // of both bounds, beside them
const polls = /^((query|search|get_command_result)(_response)?|receive_event)$/;

/** Numbers go up without end; those that are forgotten, and there may be some between others, are not there any more. */
export class DocumentLog implements Iterable<LoggedDocument> {
  private readonly said: Ring<LoggedDocument>;
  private readonly polled: Ring<LoggedDocument>;
  private next = 0;

  constructor({ most, most_bytes }: DocumentLimits) {
    // A text takes two bytes a unit at worst.
    const weigh = ({ text }: LoggedDocument) => 2 * text.length + 200;
    this.said = new Ring(most, most_bytes, weigh);
    this.polled = new Ring(Math.ceil(most * share_of_polls), most_bytes * share_of_polls, weigh);
  }

  push(document: LoggedDocument): void {
    this.next = document.number + 1;
    (document.is_own && polls.test(document.name) ? this.polled : this.said).push(document);
  }

  /** How many are there. */
  get size(): number {
    return this.said.size + this.polled.size;
  }
  get bytes(): number {
    return this.said.bytes + this.polled.bytes;
  }
  /** The number of the oldest that is there. */
  get first(): number {
    return Math.min(this.said.at(0)?.number ?? this.next, this.polled.at(0)?.number ?? this.next);
  }
  /** The number that the next one will have. */
  get end(): number {
    return this.next;
  }
  get last(): LoggedDocument | undefined {
    return this.numbered(this.next - 1);
  }
  numbered(number: number): LoggedDocument | undefined {
    return found(this.said, number) ?? found(this.polled, number);
  }
  list(): LoggedDocument[] {
    return [...this];
  }
  *[Symbol.iterator](): Iterator<LoggedDocument> {
    let [i, j] = [0, 0];
    for (;;) {
      const [one, other] = [this.said.at(i), this.polled.at(j)];
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

function found(ring: Ring<LoggedDocument>, number: number): LoggedDocument | undefined {
  let [low, high] = [0, ring.size];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (ring.at(middle)!.number < number) low = middle + 1;
    else high = middle;
  }
  const one = ring.at(low);
  return one?.number === number ? one : undefined;
}
