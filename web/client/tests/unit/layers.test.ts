// Modules of the client import only modules of lower layers.
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { test } from 'node:test';

import { root } from '../kit/gateway.js';

const source = `${root}/web/client/src`;

// From bottom to top. Modules of one layer do not import each other.
const layers = [
  ['errors', 'times'],
  ['xml', 'stream', 'listeners', 'socket', 'node_frames', 'answer_text'],
  ['browser_socket', 'node_socket', 'values'],
  ['commands', 'conditions', 'profiles', 'messages'],
  ['requests', 'execution'],
  ['answers', 'subscriptions'],
  ['link', 'everything'],
  ['client'],
  ['components'],
  ['index'],
  ['browser', 'node'],
];
const libraries: Record<string, RegExp> = { node_frames: /^node:crypto$/, node_socket: /^node:(crypto|http|https|stream|tls)$/ };

test('every module is in a layer and imports only lower ones', () => {
  const modules = readdirSync(source).map((file) => file.replace(/\.ts$/, ''));
  assert.deepEqual([...modules].sort(), layers.flat().sort());
  for (const module of modules) {
    const below = layers.slice(0, layers.findIndex((layer) => layer.includes(module))).flat();
    for (const [, from] of readFileSync(`${source}/${module}.ts`, 'utf8').matchAll(/ from '([^']+)';/g)) {
      const own = /^\.\/(.*)\.js$/.exec(from!)?.[1];
      if (own === undefined) assert.match(from!, libraries[module] ?? /^$/, `${module} may not import ${from}`);
      else assert.ok(below.includes(own), `${module} may not import ${own}`);
    }
  }
});
