// Counts watchers, for work that is done only while there is one.
import type { Stop } from './environment';

export class Watchers {
  private count = 0;

  constructor(
    /** The first watcher has come. */
    private readonly begin: () => void,
    /** The last watcher has gone. */
    private readonly end: () => void,
  ) {}

  get any(): boolean {
    return this.count > 0;
  }

  /** Watches until the returned function is called. */
  watch(): Stop {
    this.count += 1;
    if (this.count === 1) this.begin();
    let is_watching = true;
    return () => {
      if (!is_watching) return;
      is_watching = false;
      this.count -= 1;
      if (this.count === 0) this.end();
    };
  }
}
