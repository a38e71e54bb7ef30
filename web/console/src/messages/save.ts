/** Has the browser save a text file. */
export function save(name: string, pieces: string[]): void {
  const url = URL.createObjectURL(new Blob(pieces, { type: 'application/jsonl' }));
  const link = document.createElement('a');
  link.href = url;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000); // the browser has begun to read it by then
}
