// Asks again and again while somebody looks.
import type { Environment, Stop } from './environment';

export class Poll {
  private lookers = 0;
  private stop_clock: Stop | undefined;
  private is_asking = false;

  /** `ask` never runs twice at once, and only when `may_ask` says so. What it throws is its own business. */
  constructor(
    private readonly environment: Pick<Environment, 'every'>,
    private readonly period: number, // ms
    private readonly ask: () => Promise<void>,
    private readonly may_ask: () => boolean = () => true,
  ) {}

  /** Somebody looks from now on, until the function is called that this gives. The first one is served at once. */
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

  /** Asks out of turn, if somebody looks. */
  now(): void {
    if (this.is_asking || this.lookers === 0 || !this.may_ask()) return;
    this.is_asking = true;
    this.ask()
      .catch(() => undefined)
      .finally(() => (this.is_asking = false));
  }
}
