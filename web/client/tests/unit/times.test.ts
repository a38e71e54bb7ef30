// Deadlines, and times above a timer's limit, with a scripted gateway.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { Client, command } from 'rois-client';

import { Clock } from '../kit/clock.js';
import { options, Scripted, scripted } from '../kit/scripted.js';

scripted('a deadline that passes while the link is lost names the reason', {}, async (client, gateway, clock) => {
  const late = async (message: string) => {
    const outcome = assert.rejects(client.search(undefined, { deadline: 50 }), { failure: 'deadline', message });
    await clock.pass(50);
    await outcome;
  };
  await late('no answer within 50 ms');
  await gateway.socket.end('cut');
  await late('no answer within 50 ms: cut');
  await clock.pass(50);
  await gateway.socket.open();
  await late('no answer within 50 ms: cut');
  await gateway.socket.answer();
  await late('no answer within 50 ms');
});

for (const long of [3e9, Infinity])
  scripted(`a deadline of ${long} ms does not pass at once`, { deadline: long, heartbeat: long }, async (client, gateway, clock) => {
    const found = client.search();
    const none = client.notifications().next(long);
    const executing = client.execute([command('navigation', 'start', {}, { command_id: 'mine' })], { deadline: long });
    await clock.pass(100_000);
    await gateway.socket.answer();
    await gateway.socket.answer();
    assert.deepEqual(await found, []);
    const status = (await executing).status(long);
    await clock.pass(100_000);
    await gateway.socket.completed(1, 'mine');
    assert.equal(await status, 'OK');
    assert.equal((await none)?.sequence, 1);
    assert.deepEqual(gateway.socket.names, ['connect', 'search', 'execute']);
  });

for (const long of [3e9, Infinity])
  scripted(`a delay of ${long} ms does not pass at once`, { first_delay: long, most_delay: long }, async (client, gateway, clock) => {
    await gateway.socket.end('cut');
    await clock.pass(100_000);
    assert.deepEqual([client.state, gateway.sockets.length], ['lost', 1]);
  });

test('connecting without a deadline does not fail at once', async () => {
  const [clock, gateway] = [new Clock(), new Scripted()];
  const client = new Client('http://robot', options, gateway.open);
  const started = client.start(Infinity);
  await clock.pass(5_000);
  await gateway.socket.open();
  await gateway.socket.answer('<session>one</session>');
  await started;
  const closing = client.close({ deadline: Infinity });
  await clock.pass(5_000);
  await gateway.socket.answer();
  await closing;
  assert.deepEqual([gateway.socket.names, clock.waits], [['connect', 'disconnect'], 0]);
  clock.remove();
});
