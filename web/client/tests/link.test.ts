// What a client does when the network does not do its part.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';

import { type Client, type ClientOptions, command, component_ref, connect, type Gap, Navigation, parse_xml, PersonDetection, type StateChange } from 'rois-client';

import { free_port, Gateway, root } from './gateway.js';
import { Proxy } from './proxy.js';

const flags = ['--scenario', `${root}/tests/server/data/empty_hall.xml`, '--sim-speed', '100'];
const quick: ClientOptions = { first_delay: 5, most_delay: 20 };

let gateway: Gateway;
before(async () => {
  gateway = await Gateway.start(...flags, '--max-sent-notifications', '30');
});
after(() => gateway.stop());

const pause = (milliseconds: number) => new Promise((resolve) => setTimeout(resolve, milliseconds));

// What happened to a client, in order.
interface Seen {
  states: string[];
  gaps: Gap[];
  out: string[]; // names of the documents that went out
  until(state: string): Promise<void>;
}

function watched(client: Client): Seen {
  const seen: Seen = {
    states: [],
    gaps: [],
    out: [],
    until: (state) =>
      new Promise((resolve) => {
        const stop = client.on('state', (change: StateChange) => {
          if (change.state !== state) return;
          stop();
          resolve();
        });
      }),
  };
  client.on('state', ({ state }) => seen.states.push(state));
  client.on('gap', (gap) => seen.gaps.push(gap));
  client.on('document', ({ direction, text }) => direction === 'out' && seen.out.push(parse_xml(text).name));
  return seen;
}

function behind_a_proxy(name: string, options: ClientOptions, dialogue: (client: Client, proxy: Proxy, seen: Seen) => Promise<void>): void {
  test(name, async () => {
    const proxy = await Proxy.before(gateway.port);
    const client = await connect(proxy.url, { ...quick, ...options });
    try {
      await dialogue(client, proxy, watched(client));
    } finally {
      await client.close();
      await proxy.stop();
    }
  });
}

// `count` events, numbered by the text of their targets, and one completed.
const go = (client: Client, first: number, count: number) =>
  client.execute([command('navigation', 'start', { target_position: Array.from({ length: count }, (_, i) => `4000, 5000, ${first + i}e-9`) })]);

const number_of = (target: string) => Number(/(\d+)e-9$/.exec(target)![1]);

behind_a_proxy('a session that lost its link is resumed with all it had', {}, async (client, proxy, seen) => {
  const session = client.session;
  const navigation = await Navigation.bind_any(client);
  const targets = await navigation.subscribe('reached_target');
  for (let round = 0; round < 5; ++round) {
    const resumed = seen.until('resumed');
    proxy.cut();
    const status = navigation.go_to('4000, 5000');
    await resumed;
    assert.equal(await status, 'OK');
    assert.equal((await targets.next(5000))!.results.text('target'), '4000, 5000');
  }
  assert.equal(client.session, session);
  assert.deepEqual(seen.states, Array(5).fill(['lost', 'resumed']).flat());
  assert.deepEqual(seen.gaps, []);
  assert.equal(await targets.next(20), undefined);
  assert.equal(seen.out.filter((name) => name === 'subscribe').length, 1);
});

behind_a_proxy('what happened while the link was lost is told afterwards, in order', {}, async (client, proxy, seen) => {
  await client.bind('navigation');
  const targets = await client.subscribe('reached_target');
  const execution = await go(client, 0, 20);
  proxy.refuses = true;
  proxy.cut();
  await seen.until('lost');
  await until_ended_elsewhere(client, execution.command_ids[0]!);
  proxy.refuses = false;
  assert.equal(await execution.status(5000), 'OK');
  for (let i = 0; i < 20; ++i) assert.equal(number_of((await targets.next(5000))!.results.text('target')!), i);
  assert.deepEqual(seen.gaps, []);
});

// Another way to the same session: over HTTP, as the wire allows.
async function until_ended_elsewhere(client: Client, command_id: string): Promise<void> {
  for (;;) {
    const answer = await fetch(`${gateway.url}/rois`, {
      method: 'POST',
      headers: { 'Content-Type': 'application/xml', 'RoIS-Session': client.session },
      body: `<get_command_result xmlns="urn:x-rois:psm:xml:message:1"><command_id>${command_id}</command_id></get_command_result>`,
    });
    if (!/RUNNING|WAITING/.test(await answer.text())) return;
  }
}

behind_a_proxy('a gap is told with its size when the gateway has forgotten what was missed', {}, async (client, proxy, seen) => {
  await client.bind('navigation');
  const targets = await client.subscribe('reached_target');
  proxy.half_open(); // the gateway goes on sending for a while, to nobody
  proxy.refuses = true;
  const executed = await fetch(`${gateway.url}/rois`, {
    method: 'POST',
    headers: { 'Content-Type': 'application/xml', 'RoIS-Session': client.session },
    body: `<execute xmlns="urn:x-rois:psm:xml:message:1" xmlns:rois="http://www.omg.org/spec/RoIS/20240801" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"><rois:CommandUnitSequence><rois:command_unit_list xsi:type="rois:CommandMessageType" rois:command_type="start" rois:command_id="far"><rois:component_ref rois:code="navigation"/><rois:arguments><rois:parameter rois:name="target_position"><rois:data_type_ref rois:code="string[]"/>${Array.from({ length: 80 }, (_, i) => `<rois:value>4000, 5000, ${i}e-9</rois:value>`).join('')}</rois:parameter></rois:arguments></rois:command_unit_list></rois:CommandUnitSequence></execute>`,
  });
  assert.match(await executed.text(), /return_code="OK"/);
  await until_ended_elsewhere(client, 'far');
  // Reading them marks them as sent; thirty of these are kept.
  await fetch(`${gateway.url}/rois/notifications`, { headers: { 'RoIS-Session': client.session } });
  proxy.refuses = false;
  proxy.cut();
  await seen.until('resumed');
  const last = (await targets.next(5000))!;
  assert.equal(seen.gaps.length, 1);
  const gap = seen.gaps[0]!;
  assert.ok(gap.reason === 'lost');
  assert.equal(gap.first, 1);
  assert.equal(gap.count, 51, '81 notifications, 30 kept');
  assert.equal(gap.last, gap.count);
  assert.equal(last.sequence, gap.last + 1);
  const rest = [last];
  while (rest.length < 29) rest.push((await targets.next(5000))!);
  assert.deepEqual(rest.map((event) => number_of(event.results.text('target')!)), Array.from({ length: 29 }, (_, i) => 51 + i));
  assert.equal(await targets.next(20), undefined);
});

behind_a_proxy('a link that is dead without saying so is given up', { heartbeat: 250 }, async (client, proxy, seen) => {
  const resumed = seen.until('resumed');
  proxy.half_open();
  await resumed;
  assert.deepEqual(seen.states, ['lost', 'resumed']);
  // The same while a call waits.
  const again = seen.until('resumed');
  proxy.half_open();
  assert.equal((await client.search()).length, 15);
  await again;
});

behind_a_proxy('a gateway that is silent but there is left alone', { heartbeat: 150 }, async (client, _, seen) => {
  while (seen.out.filter((name) => name === 'connect').length < 3) await client.notifications().next(10);
  assert.deepEqual(seen.states, []);
});

behind_a_proxy('every call ends with its deadline', { deadline: 1000 }, async (client, proxy, seen) => {
  proxy.refuses = true;
  proxy.cut();
  await seen.until('lost');
  await assert.rejects(client.search(), { failure: 'deadline', message: 'no answer within 1000 ms' });
  await assert.rejects(client.search(undefined, { deadline: 1 }), { message: 'no answer within 1 ms' });
  await assert.rejects(client.execute([command('move', 'start')], { deadline: 20 }), { failure: 'deadline' });
  proxy.refuses = false;
  await seen.until('resumed');
  assert.deepEqual(seen.out.filter((name) => name !== 'resume'), [], 'what nobody waits for is not sent');
});

behind_a_proxy('a call whose deadline has passed is not sent again', {}, async (client, proxy, seen) => {
  proxy.half_open();
  await assert.rejects(client.search(undefined, { deadline: 10 }), { failure: 'deadline' });
  const resumed = seen.until('resumed');
  proxy.cut();
  await resumed;
  await client.get_profile();
  assert.deepEqual(seen.out, ['search', 'resume', 'get_profile']);
});

behind_a_proxy('a name that was used before does not make a lost command an accepted one', {}, async (client, proxy) => {
  await client.bind('navigation');
  const mine = [command('navigation', 'start', { target_position: ['4000, 5000'] }, { command_id: 'mine' })];
  assert.equal(await (await client.execute(mine)).status(5000), 'OK');
  proxy.half_open();
  await Promise.all([assert.rejects(client.execute(mine), { failure: 'link_lost' }), proxy.cut()]);
});

behind_a_proxy('an answer after the deadline is nobody else\'s', {}, async (client, proxy) => {
  proxy.lateness = 40;
  await assert.rejects(client.query('robot_position', undefined, { deadline: 10 }), { failure: 'deadline' });
  proxy.lateness = 0;
  assert.equal((await client.search()).length, 15);
});

behind_a_proxy('documents that come byte by byte are the same', { heartbeat: 60_000 }, async (client, proxy, seen) => {
  proxy.drip = 1;
  const detection = await PersonDetection.bind_any(client);
  const detected = await detection.subscribe('person_detected');
  await detection.start();
  assert.equal((await detected.next(5000))!.results.number('number'), 0);
  assert.deepEqual(seen.states, []);
});

behind_a_proxy('what must not be repeated unasked fails when the link breaks', {}, async (client, proxy, seen) => {
  proxy.half_open();
  const sent = client.send('<search xmlns="urn:x-rois:psm:xml:message:1"/>');
  proxy.cut();
  await assert.rejects(sent, { failure: 'link_lost' });
  if (client.state !== 'resumed') await seen.until('resumed');
  assert.equal((await client.send('<search xmlns="urn:x-rois:psm:xml:message:1"/>')).name, 'search_response');
});

// The link is cut at every byte of an execute and its answer: it runs once.
behind_a_proxy('a command is executed once wherever the link is cut', {}, async (client, proxy, seen) => {
  await client.bind('navigation');
  const targets = await client.subscribe('reached_target');
  let number = 0;
  for (let bytes = 1; bytes < 3000; bytes += 97) {
    let left = 1;
    proxy.next_cut = () => (left-- > 0 ? bytes : Infinity);
    proxy.cut_after_next();
    assert.equal(await (await go(client, number, 2)).status(5000), 'OK', `${bytes}`);
    for (let i = 0; i < 2; ++i) assert.equal(number_of((await targets.next(5000))!.results.text('target')!), number++);
  }
  assert.ok(seen.states.filter((state) => state === 'resumed').length > 20, seen.states.join());
  assert.deepEqual(seen.gaps, []);
  assert.equal(await targets.next(20), undefined);
});

// The same for bind_any: a second one would take another component of the type.
test('bind_any binds one wherever the link is cut', async () => {
  const two = await Gateway.start('--floor-plan', `${root}/components/simulation/data/two-robots.xml`, ...flags);
  const proxy = await Proxy.before(two.port);
  const client = await connect(proxy.url, quick);
  for (let bytes = 1; bytes < 1500; bytes += 61) {
    let left = 1;
    proxy.next_cut = () => (left-- > 0 ? bytes : Infinity);
    proxy.cut_after_next();
    const bound = await client.bind_any('Navigation');
    const free = (await client.search()).length;
    assert.ok(free > 15);
    const other = await connect(two.url);
    assert.notEqual((await other.bind_any('Navigation')).code, bound.code, `${bytes}: the second one is free`);
    await other.close();
    await client.release(bound);
  }
  await client.close();
  await proxy.stop();
  await two.stop();
});

test('a lost session is told, and a new one has its subscriptions, each once', async () => {
  const port = await free_port();
  const listen = ['--listen', `127.0.0.1:${port}`];
  let engine = await Gateway.start(...flags, ...listen);
  const client = await connect(engine.url, quick);
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
  engine = await Gateway.start(...flags, ...listen);
  await open;
  await outcome;
  assert.notEqual(client.session, first);
  assert.deepEqual(seen.states, ['lost', ...seen.states.filter((state) => state === 'lost').slice(1), 'open']);
  assert.deepEqual(seen.gaps.filter((gap) => gap.reason === 'session').length, 1);
  await assert.rejects(execution.status(1000), { failure: 'session_lost' });
  await client.bind('navigation');
  assert.equal(await (await go(client, 0, 3)).status(5000), 'OK');
  for (const subscription of [one, same]) {
    for (let i = 0; i < 3; ++i) assert.equal(number_of((await subscription.next(5000))!.results.text('target')!), i);
    assert.equal(await subscription.next(20), undefined);
  }
  assert.equal(one.subscribe_id, same.subscribe_id);
  assert.notEqual(one.subscribe_id, other.subscribe_id);
  await client.close();
  await engine.stop();
});

test('commands that an engine stops while it shuts down have ended, and say so', async () => {
  const engine = await Gateway.start(...flags);
  const client = await connect(engine.url, quick);
  await client.bind('navigation');
  const execution = await client.execute([command('navigation', 'start', { target_position: ['desk'] }, { delay_time: 60_000 })]);
  await engine.stop();
  assert.equal(await execution.status(5000), 'ABORT');
  await client.close({ deadline: 1 });
});

test('a session that the engine ended on a living link is told, too', async () => {
  const client = await connect(gateway.url, quick);
  const seen = watched(client);
  const detected = await client.subscribe('person_detected');
  // Ended over HTTP, behind the client's back.
  await fetch(`${gateway.url}/rois`, {
    method: 'POST',
    headers: { 'Content-Type': 'application/xml', 'RoIS-Session': client.session },
    body: '<disconnect xmlns="urn:x-rois:psm:xml:message:1"/>',
  });
  const open = seen.until('open');
  await assert.rejects(client.search(), { failure: 'session_lost' });
  await open;
  assert.deepEqual(seen.gaps, [{ reason: 'session' }]);
  const detection = await PersonDetection.bind_any(client);
  await detection.start();
  assert.equal((await detected.next(5000))!.results.number('number'), 0);
  await client.close();
});

behind_a_proxy('a subscription that a new session refuses ends with the refusal', {}, async (client) => {
  const narrow = await client.subscribe('reached_target');
  (narrow.wanted as { event_type: string }).event_type = 'sunrise'; // as if its component had gone
  await fetch(`${gateway.url}/rois`, {
    method: 'POST',
    headers: { 'Content-Type': 'application/xml', 'RoIS-Session': client.session },
    body: '<disconnect xmlns="urn:x-rois:psm:xml:message:1"/>',
  });
  await assert.rejects(client.search(), { failure: 'session_lost' });
  await assert.rejects(narrow.next(), { failure: 'refused', return_code: 'UNSUPPORTED' });
});

behind_a_proxy('a client that is closed while its link is lost ends its session all the same', {}, async (client, proxy, seen) => {
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

test('a client whose session has ended meanwhile is closed without a new one', async () => {
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

behind_a_proxy('a client that could not end its session stays closed', {}, async (client, proxy, seen) => {
  proxy.refuses = true;
  proxy.cut();
  await seen.until('lost');
  await client.close({ deadline: 50 });
  await pause(50); // for a try that was on its way
  const made = proxy.made;
  proxy.refuses = false;
  await pause(50); // more than the longest delay between two tries
  assert.equal(proxy.made, made);
  assert.equal(client.state, 'closed');
});

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
