// Things that come by and by, awaited one after the other.
import { for_timer } from './times.js';

/** Bounded: when nobody takes them, the oldest go. One reader at a time sees each of them; several share them. */
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

  /** No more will come; what waits can still be taken. With an error, readers get it in the end. */
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

  /** Forgets what waits. */
  clear(): void {
    this.waiting.length = 0;
  }

  /** The next one; undefined when none comes within so many milliseconds, or none will come any more. */
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
