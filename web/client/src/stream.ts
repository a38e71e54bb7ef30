// An async queue.
import { for_timer } from './times.js';

/** A bounded queue that drops the oldest item when full. Each item goes to one reader. */
export class Stream<T> implements AsyncIterable<T> {
  private readonly waiting: T[] = [];
  private readonly takers: { resolve(taken: T | undefined): void; reject(error: unknown): void }[] = [];
  private over: { error?: unknown } | undefined;

  constructor(
    private readonly capacity: number,
    private readonly dropped: (count: number) => void,
  ) {}

  push(one: T): void {
    if (this.over) return;
    const taker = this.takers.shift();
    if (taker) {
      taker.resolve(one);
      return;
    }
    this.waiting.push(one);
    if (this.waiting.length <= this.capacity) return;
    this.waiting.shift();
    this.dropped(1);
  }

  /** Ends the stream. Queued items can still be read; after them, readers get the error if there is one. */
  end(error?: unknown): void {
    if (this.over) return;
    this.over = error === undefined ? {} : { error };
    for (const taker of this.takers.splice(0)) {
      if (error === undefined) taker.resolve(undefined);
      else taker.reject(error);
    }
  }

  get ended(): boolean {
    return this.over !== undefined;
  }

  /** Drops the queued items. */
  clear(): void {
    this.waiting.length = 0;
  }

  /** Returns the next item; undefined after this timeout, or if the stream has ended. Rejects with the error of `end`. */
  next(milliseconds?: number): Promise<T | undefined> {
    if (this.waiting.length > 0) return Promise.resolve(this.waiting.shift());
    if (this.over) return 'error' in this.over ? Promise.reject(this.over.error) : Promise.resolve(undefined);
    return new Promise<T | undefined>((resolve, reject) => {
      const taker = { resolve, reject };
      this.takers.push(taker);
      if (milliseconds === undefined) return;
      const timer = setTimeout(() => {
        this.takers.splice(this.takers.indexOf(taker), 1);
        resolve(undefined);
      }, for_timer(milliseconds));
      taker.resolve = (taken) => {
        clearTimeout(timer);
        resolve(taken);
      };
      taker.reject = (error) => {
        clearTimeout(timer);
        reject(error);
      };
    });
  }

  async *[Symbol.asyncIterator](): AsyncGenerator<T, void, undefined> {
    for (;;) {
      const one = await this.next();
      if (one === undefined) return;
      yield one;
    }
  }
}
