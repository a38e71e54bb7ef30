// Timer limits.

/** Limits a delay to a timer's range of 24 days; a longer delay would fire at once. */
export function for_timer(milliseconds: number): number {
  return Math.min(milliseconds, 2 ** 31 - 1);
}
