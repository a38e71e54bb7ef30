// Files of the user's own machine.

/** Asks for one; undefined when the user thinks better of it. */
export function chosen_file(types: string): Promise<File | undefined> {
  const input = document.createElement('input');
  input.type = 'file';
  input.accept = types;
  return new Promise((resolve) => {
    input.addEventListener('change', () => resolve(input.files?.[0]));
    input.addEventListener('cancel', () => resolve(undefined));
    input.click();
  });
}

/** Has the browser save one. */
export function save_file(name: string, pieces: string[]): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob(pieces));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000); // the browser has begun to read it by then
}
