// Polls while at least one caller watches.
import type { Environment, Stop } from './environment';
import { Watchers } from './watchers';

export class Poll {
  private readonly watchers: Watchers;
  private stop_clock = () => {};
  private is_asking = false;

  /** `ask` is called only if `may_ask` allows it, never twice at a time. Its errors are ignored. */
  constructor(
    private readonly environment: Pick<Environment, 'every'>,
    private readonly period: number, // ms
    private readonly ask: () => Promise<void>,
    private readonly may_ask: () => boolean = () => true,
  ) {
    const begin = () => {
      this.stop_clock = this.environment.every(this.period, () => this.now());
      this.now();
    };
    this.watchers = new Watchers(begin, () => this.stop_clock());
  }

  /** Watches until the returned function is called. The first watcher polls at once. */
  watch(): Stop {
    return this.watchers.watch();
  }

  /** Polls at once if watched. */
  now(): void {
    if (this.is_asking || !this.watchers.any || !this.may_ask()) return;
    this.is_asking = true;
    this.ask()
      .catch(() => undefined)
      .finally(() => (this.is_asking = false));
  }
}
