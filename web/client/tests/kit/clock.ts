// A fake clock: timers fire when the test advances the time.

interface Waiting {
  at: number; // ms
  every: number | undefined; // ms
  happen(): void;
}

/** Resolves when pending callbacks and promises have run. */
export const settled = () => new Promise((resolve) => setImmediate(resolve));

export class Clock {
  private readonly real = { setTimeout, clearTimeout, setInterval, clearInterval };
  private readonly waiting = new Set<Waiting>();
  private time = 0; // ms

  /** Replaces the global timers until `remove`. */
  constructor() {
    // Like the real timers, treats a delay of 2^31 ms or more as 1 ms.
    const taken = (milliseconds: number) => (milliseconds < 2 ** 31 ? milliseconds : 1);
    const wait = (happen: () => void, milliseconds: number, every?: number) => {
      const one = { at: this.time + taken(milliseconds), every: every && taken(every), happen };
      this.waiting.add(one);
      return one;
    };
    const forget = (one: Waiting) => void this.waiting.delete(one);
    Object.assign(globalThis, {
      setTimeout: (happen: () => void, milliseconds: number) => wait(happen, milliseconds),
      setInterval: (happen: () => void, milliseconds: number) => wait(happen, milliseconds, milliseconds),
      clearTimeout: forget,
      clearInterval: forget,
    });
    Object.defineProperty(performance, 'now', { value: () => this.time, configurable: true });
  }

  remove(): void {
    Object.assign(globalThis, this.real);
    delete (performance as { now?: unknown }).now; // removes the own property, which hides that of the class
  }

  /** Number of pending timers. */
  get waits(): number {
    return this.waiting.size;
  }

  async pass(milliseconds: number): Promise<void> {
    const end = this.time + milliseconds;
    for (let next = this.next(); next && next.at <= end; next = this.next()) {
      this.time = next.at;
      if (next.every === undefined) this.waiting.delete(next);
      else next.at += next.every;
      next.happen();
      await settled();
    }
    this.time = end;
    await settled();
  }

  private next(): Waiting | undefined {
    return [...this.waiting].sort((a, b) => a.at - b.at)[0];
  }
}
