// Times as timers take them.

/** As many ms, but no more than a timer takes, which are those of 24 days: what is longer would be over at once. */
export function for_timer(milliseconds: number): number {
  return Math.min(milliseconds, 2 ** 31 - 1);
}
