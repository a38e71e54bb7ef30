/** The message of a thrown value. */
export function reason_of(thrown: unknown): string {
  return thrown instanceof Error ? thrown.message : String(thrown);
}
