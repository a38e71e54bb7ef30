// Sessions that end while their client lives, and clients that end their session.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { command, component_ref, connect, PersonDetection } from 'rois-client';

import { Gateway } from '../kit/gateway.js';
import { Proxy } from '../kit/proxy.js';
import { behind_a_proxy, flags, gateway, go, number_of, quick, said_over_http, watched } from '../kit/stage.js';

test('a lost session is reported, and the new one has its subscriptions, each once', async () => {
  let engine = await Gateway.start(...flags);
  const proxy = await Proxy.before(engine.port);
  const client = await connect(proxy.url, quick);
  const seen = watched(client);
  const first = client.session;
  await client.bind('navigation');
  const [one, same] = [await client.subscribe('reached_target'), await client.subscribe('reached_target')];
  const other = await client.subscribe('person_detected', { inline_results: false });
  const execution = await client.execute([command('navigation', 'start', { target_position: ['9000, 4500'] }), command('navigation', 'start', { target_position: ['desk'] }, { delay_time: 60_000 })]);
  const lost = seen.until('lost');
  await engine.stop('SIGKILL');
  await lost;
  const pending = client.search();
  const outcome = assert.rejects(pending, { failure: 'session_lost' });
  const open = seen.until('open');
  engine = await Gateway.start(...flags);
  proxy.target = engine.port;
  await open;
  await outcome;
  assert.notEqual(client.session, first);
  assert.deepEqual(seen.states, ['lost', ...seen.states.filter((state) => state === 'lost').slice(1), 'open']);
  assert.deepEqual(seen.gaps.filter((gap) => gap.reason === 'session').length, 1);
  await assert.rejects(execution.status(1000), { failure: 'session_lost' });
  assert.equal(await (await go(client, 0, 3)).status(5000), 'OK');
  for (const subscription of [one, same]) {
    for (let i = 0; i < 3; ++i) assert.equal(number_of((await subscription.next(5000))!.results.text('target')!), i);
    assert.equal(await subscription.next(20), undefined);
  }
  assert.equal(one.subscribe_id, same.subscribe_id);
  assert.notEqual(one.subscribe_id, other.subscribe_id);
  await client.close();
  await proxy.stop();
  await engine.stop();
});

test('commands that the engine stops during shutdown end and are reported', async () => {
  const engine = await Gateway.start(...flags);
  const client = await connect(engine.url, quick);
  await client.bind('navigation');
  const execution = await client.execute([command('navigation', 'start', { target_position: ['desk'] }, { delay_time: 60_000 })]);
  await engine.stop();
  assert.equal(await execution.status(5000), 'ABORT');
  await client.close({ deadline: 1 });
});

test('a session that the engine ended on a live link is reported', async () => {
  const client = await connect(gateway.url, quick);
  const seen = watched(client);
  const detected = await client.subscribe('person_detected');
  await said_over_http(client, 'disconnect'); // without the client's knowledge
  const open = seen.until('open');
  await assert.rejects(client.search(), { failure: 'session_lost' });
  await open;
  assert.deepEqual(seen.gaps, [{ reason: 'session' }]);
  const detection = await PersonDetection.bind_any(client);
  await detection.start();
  assert.equal((await detected.next(5000))!.results.number('number'), 0);
  await client.close();
});

behind_a_proxy('a client that is closed during a broken link still ends its session', {}, async (client, proxy, seen) => {
  await client.bind('follow');
  proxy.refuses = true;
  proxy.cut();
  await seen.until('lost');
  const outcome = assert.rejects(client.search(), { failure: 'closed' });
  const closing = client.close();
  await outcome;
  await assert.rejects(Promise.race([closing, new Promise((_, reject) => setTimeout(reject, 30, 'waits'))]), (why) => why === 'waits');
  proxy.refuses = false;
  await Promise.all([closing, client.close()]);
  assert.equal(client.state, 'closed');
  assert.deepEqual(seen.out, ['bind', 'resume', 'disconnect']);
  const next = await connect(gateway.url);
  await next.bind('follow');
  await next.close();
});

test('closing a client whose session has ended begins no new one', async () => {
  const engine = await Gateway.start(...flags, '--resume-window', '0.01');
  const proxy = await Proxy.before(engine.port);
  const client = await connect(proxy.url, quick);
  await client.bind('follow');
  const seen = watched(client);
  proxy.refuses = true;
  proxy.cut();
  await seen.until('lost');
  const other = await connect(engine.url);
  while ((await other.query('component_status', component_ref('follow'))).results.text('status') === 'BUSY');
  await other.close();
  const closing = client.close();
  proxy.refuses = false;
  await closing;
  assert.deepEqual(seen.out, ['resume']);
  await proxy.stop();
  await engine.stop();
});

const pause = (milliseconds: number) => new Promise((resolve) => setTimeout(resolve, milliseconds));

behind_a_proxy('a client that could not end its session stays closed', {}, async (client, proxy, seen) => {
  proxy.refuses = true;
  proxy.cut();
  await seen.until('lost');
  await client.close({ deadline: 50 });
  await pause(50); // for a retry under way
  const made = proxy.made;
  proxy.refuses = false;
  await pause(50); // longer than the longest delay
  assert.equal(proxy.made, made);
  assert.equal(client.state, 'closed');
});
