/** What was thrown, in its own words. */
export function reason_of(thrown: unknown): string {
  return thrown instanceof Error ? thrown.message : String(thrown);
}
