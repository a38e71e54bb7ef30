/** Joins the non-empty texts with spaces: class names, sentences. */
export function joined(...all: (string | false | undefined)[]): string {
  return all.filter(Boolean).join(' ');
}
