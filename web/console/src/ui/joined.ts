/** What there is of it, with blanks between: names of classes, sentences. */
export function joined(...all: (string | false | undefined)[]): string {
  return all.filter(Boolean).join(' ');
}
