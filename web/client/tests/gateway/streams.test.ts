// Streams and listeners.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { Stream } from 'rois-client';

import { Clock } from '../kit/clock.js';
import { behind_a_proxy, go, number_of } from '../kit/stage.js';

const unlimited = () => new Stream<number>(Infinity, () => assert.fail());

async function rest_of(stream: Stream<number>): Promise<number[]> {
  const rest: number[] = [];
  for await (const one of stream) rest.push(one);
  return rest;
}

test('a stream keeps its order, and drops the oldest item when full', async () => {
  let dropped = 0;
  const stream = new Stream<number>(3, (count) => (dropped += count));
  for (let n = 1; n <= 3; ++n) stream.push(n);
  assert.equal(dropped, 0);
  for (let n = 4; n <= 5; ++n) stream.push(n);
  assert.equal(dropped, 2);
  assert.equal(await stream.next(), 3);
  stream.end();
  stream.push(9);
  assert.deepEqual(await rest_of(stream), [4, 5]);
  assert.equal(await stream.next(), undefined);
});

test('waiting readers get one item each, first come, first served', async () => {
  const stream = unlimited();
  const waiting = [stream.next(), stream.next(), stream.next()];
  for (let n = 1; n <= 4; ++n) stream.push(n);
  assert.deepEqual(await Promise.all(waiting), [1, 2, 3]);
  assert.equal(await stream.next(), 4);
});

test('next returns after its timeout', async () => {
  const [clock, stream] = [new Clock(), unlimited()];
  try {
    const [patient, hasty] = [stream.next(1000), stream.next(10)];
    await clock.pass(10);
    assert.equal(await hasty, undefined);
    stream.push(1);
    stream.push(2);
    assert.equal(await patient, 1);
    assert.equal(await stream.next(10), 2, 'the expired reader did not take it');
    const failing = stream.next(10);
    stream.end(new Error('over'));
    await assert.rejects(failing, { message: 'over' });
    assert.equal(clock.waits, 0);
  } finally {
    clock.remove();
  }
});

test('a stream rejects with its error after the last item', async () => {
  const stream = unlimited();
  const waiting = [stream.next(), stream.next()];
  stream.push(1);
  const outcome = assert.rejects(waiting[1]!, { message: 'over' });
  stream.end(new Error('over'));
  stream.end();
  assert.equal(await waiting[0], 1);
  await outcome;
  await assert.rejects(stream.next(), { message: 'over' });
  const late = unlimited();
  for (const n of [1, 2]) late.push(n);
  late.end(new Error('over'));
  const read: number[] = [];
  await assert.rejects(async () => {
    for await (const one of late) read.push(one);
  }, { message: 'over' });
  assert.deepEqual(read, [1, 2]);
});

test('a stream without an error resolves its waiting readers', async () => {
  const stream = unlimited();
  const [waiting, reading] = [stream.next(), rest_of(stream)];
  stream.end();
  stream.end(new Error('too late'));
  assert.equal(await waiting, undefined);
  assert.deepEqual(await reading, []);
  assert.equal(await stream.next(), undefined);
});

test('clear drops the queued items', async () => {
  const stream = unlimited();
  for (const n of [1, 2]) stream.push(n);
  stream.clear();
  stream.push(3);
  assert.equal(await stream.next(), 3);
});

behind_a_proxy('a slow reader is reported what was dropped', { buffer: 10 }, async (client, _, seen) => {
  await client.bind('navigation');
  const targets = await client.subscribe('reached_target');
  assert.equal(await (await go(client, 0, 25)).status(5000), 'OK');
  assert.equal(seen.gaps.length, 15);
  assert.deepEqual(seen.gaps[0], { reason: 'buffer', count: 1 });
  assert.equal(number_of((await targets.next())!.results.text('target')!), 15);
});

behind_a_proxy('a listener that throws does not affect the others', {}, async (client, _, seen) => {
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
