// Time that a test holds: what waits for it happens when the test lets it pass.

interface Waiting {
  at: number; // ms
  every: number | undefined; // ms
  happen(): void;
}

/** What has come in the meantime is done, and promises are kept. */
export const settled = () => new Promise((resolve) => setImmediate(resolve));

export class Clock {
  private readonly real = { setTimeout, clearTimeout, setInterval, clearInterval };
  private readonly waiting = new Set<Waiting>();
  private time = 0; // ms

  /** Stands in for the program's own, until `remove`. */
  constructor() {
    // What is longer than a timer takes is over at once, as with the real ones.
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
    delete (performance as { now?: unknown }).now; // the own one is above that of its class
  }

  /** How many things wait. */
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
