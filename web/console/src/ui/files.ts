// Files of the user's machine.

/** Lets the user choose a file; undefined if cancelled. */
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

/** Saves a file by download. */
export function save_file(name: string, pieces: string[]): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob(pieces));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000); // the download has started by then
}
