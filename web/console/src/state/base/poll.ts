// Polls while at least one caller watches.
import type { Environment, Stop } from './environment';

export class Poll {
  private lookers = 0;
  private stop_clock: Stop | undefined;
  private is_asking = false;

  /** `ask` is called only if `may_ask` allows it, never twice at a time. Its errors are ignored. */
  constructor(
    private readonly environment: Pick<Environment, 'every'>,
    private readonly period: number, // ms
    private readonly ask: () => Promise<void>,
    private readonly may_ask: () => boolean = () => true,
  ) {}

  /** Watches until the returned function is called. The first watcher polls at once. */
  watch(): Stop {
    this.lookers += 1;
    if (this.lookers === 1) {
      this.stop_clock = this.environment.every(this.period, () => this.now());
      this.now();
    }
    let looks = true;
    return () => {
      if (!looks) return;
      looks = false;
      this.lookers -= 1;
      if (this.lookers === 0) this.stop_clock?.();
    };
  }

  /** Polls at once if watched. */
  now(): void {
    if (this.is_asking || this.lookers === 0 || !this.may_ask()) return;
    this.is_asking = true;
    this.ask()
      .catch(() => undefined)
      .finally(() => (this.is_asking = false));
  }
}
