// Those who read and those who listen.
import assert from 'node:assert/strict';

import { behind_a_proxy, go, number_of } from './stage.js';

behind_a_proxy('whoever reads too slowly is told what was dropped', { buffer: 10 }, async (client, _, seen) => {
  await client.bind('navigation');
  const targets = await client.subscribe('reached_target');
  assert.equal(await (await go(client, 0, 25)).status(5000), 'OK');
  assert.equal(seen.gaps.length, 15);
  assert.deepEqual(seen.gaps[0], { reason: 'buffer', count: 1 });
  assert.equal(number_of((await targets.next())!.results.text('target')!), 15);
});

behind_a_proxy('a listener that throws hinders nobody else', {}, async (client, _, seen) => {
  const reported: (() => void)[] = [];
  const report = globalThis.queueMicrotask;
  globalThis.queueMicrotask = (task) => void reported.push(task);
  const stop = client.on('document', () => {
    throw new Error('mine');
  });
  const later: string[] = [];
  client.on('document', ({ direction }) => later.push(direction));
  assert.equal((await client.search()).length, 15);
  stop();
  globalThis.queueMicrotask = report;
  assert.deepEqual(later, ['out', 'in']);
  assert.deepEqual(seen.states, []);
  assert.equal(reported.length, 2);
  assert.throws(reported[0]!, { message: 'mine' });
});
