import { readdirSync, readFileSync } from 'node:fs';
import { expect, it } from 'vitest';

import { kept } from '../../lighter';

const root = new URL('../..', import.meta.url).pathname;

const text_of = (folder: string, ending: string) =>
  readdirSync(`${root}/${folder}`, { recursive: true })
    .map(String)
    .filter((name) => name.endsWith(ending))
    .map((name) => readFileSync(`${root}/${folder}/${name}`, 'utf8'))
    .join('\n');

it('keeps the names of the classes that tests look for', () => {
  const classes = new Set(text_of('src', '.css').match(/(?<=\.)[a-z]+(-[a-z]+)+/g));
  const looked_for = text_of('tests/e2e', '.ts').match(/(?<=\.)[a-z]+(-[a-z]+)+(?![\w-])/g) ?? [];
  expect(looked_for.length).toBeGreaterThan(50);
  expect(looked_for.filter((name) => classes.has(name) && !kept.has(name))).toEqual([]);
});
