// A session's commands, which the client keeps no longer than needed.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { RoisError } from 'rois-client';

import { Commands } from '#dist/execution.js';

test('a command waits until it has ended or was rejected', async () => {
  const commands = new Commands();
  const [a, b] = [commands.expect('a'), commands.expect('b')];
  assert.equal(commands.expect('a'), a);
  commands.completed({ name: 'completed', sequence: 1, command_id: 'a', status: 'ABORT' });
  assert.equal(await a, 'ABORT');
  assert.notEqual(commands.expect('a'), a);
  commands.forget(['b']);
  assert.notEqual(commands.expect('b'), b);
});

test('the last 2,000 ids count as used', () => {
  const commands = new Commands();
  const names = Array.from({ length: 2003 }, (_, i) => `${i}`);
  for (let i = 0; i < 2000; ++i) commands.use([names[i]!]);
  assert.ok(commands.is_used('0'));
  commands.use(names.slice(2000));
  assert.deepEqual(names.filter((name) => !commands.is_used(name)), ['0', '1', '2']);
});

test('nothing remains of a lost session', async () => {
  const commands = new Commands();
  const a = commands.expect('a');
  commands.use(['a']);
  commands.fail(new RoisError('session_lost', 'gone'));
  await assert.rejects(a, { message: 'gone' });
  assert.notEqual(commands.expect('a'), a);
  assert.ok(!commands.is_used('a'));
});
