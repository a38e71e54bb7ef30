// The commands of a session, which a client keeps no longer than needed.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { RoisError } from 'rois-client';

import { Commands } from '#dist/execution.js';

test('a name is waited for once, until it has ended or was not accepted', async () => {
  const commands = new Commands();
  const [a, b] = [commands.expect('a'), commands.expect('b')];
  assert.equal(commands.expect('a'), a);
  commands.completed({ name: 'completed', sequence: 1, command_id: 'a', status: 'ABORT' });
  assert.equal(await a, 'ABORT');
  assert.notEqual(commands.expect('a'), a);
  commands.forget(['b']);
  assert.notEqual(commands.expect('b'), b);
});

test('the last 2,000 names are known to be used', () => {
  const commands = new Commands();
  const names = Array.from({ length: 2003 }, (_, i) => `${i}`);
  for (let i = 0; i < 2000; ++i) commands.use([names[i]!]);
  assert.ok(commands.is_used('0'));
  commands.use(names.slice(2000));
  assert.deepEqual(names.filter((name) => !commands.is_used(name)), ['0', '1', '2']);
});

test('nothing is left of a session that is gone', async () => {
  const commands = new Commands();
  const a = commands.expect('a');
  commands.use(['a']);
  commands.fail(new RoisError('session_lost', 'gone'));
  await assert.rejects(a, { message: 'gone' });
  assert.notEqual(commands.expect('a'), a);
  assert.ok(!commands.is_used('a'));
});
