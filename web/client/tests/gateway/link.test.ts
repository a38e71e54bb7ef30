// The client on a failing network.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { type Client, command, connect, Navigation, PersonDetection, property, SpeechSynthesis } from 'rois-client';

import { Gateway, root } from '../kit/gateway.js';
import { Proxy } from '../kit/proxy.js';
import { behind_a_proxy, flags, gateway, go, number_of, quick, said_over_http } from '../kit/stage.js';

behind_a_proxy('a session is resumed with bindings, commands and subscriptions after its link broke', {}, async (client, proxy, seen) => {
  const session = client.session;
  const navigation = await Navigation.bind_any(client);
  const targets = await navigation.subscribe('reached_target');
  for (let round = 0; round < 5; ++round) {
    const resumed = seen.until('resumed');
    proxy.cut();
    const status = navigation.go_to('4000, 5000');
    await resumed;
    assert.equal(String(await status), 'OK');
    assert.equal((await targets.next(5000))!.results.text('target'), '4000, 5000');
  }
  assert.equal(client.session, session);
  assert.deepEqual(seen.states, Array(5).fill(['lost', 'resumed']).flat());
  assert.deepEqual(seen.gaps, []);
  assert.equal(await targets.next(20), undefined);
  assert.equal(seen.out.filter((name) => name === 'subscribe').length, 1);
});

behind_a_proxy('notifications missed during a broken link are received afterwards, in order', {}, async (client, proxy, seen) => {
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

async function until_ended_elsewhere(client: Client, command_id: string): Promise<void> {
  while (/RUNNING|WAITING/.test(await said_over_http(client, 'get_command_result', `<command_id>${command_id}</command_id>`)));
}

behind_a_proxy('a gap is reported with its size when the gateway has dropped notifications', {}, async (client, proxy, seen) => {
  await client.bind('navigation');
  const targets = await client.subscribe('reached_target');
  proxy.half_open(); // the gateway goes on sending into the void for a while
  proxy.refuses = true;
  const places = Array.from({ length: 80 }, (_, i) => `<rois:value>4000, 5000, ${i}e-9</rois:value>`).join('');
  const argument = `<rois:parameter rois:name="target_position"><rois:data_type_ref rois:code="string[]"/>${places}</rois:parameter>`;
  const far = `<rois:command_unit_list xsi:type="rois:CommandMessageType" rois:command_type="start" rois:command_id="far"><rois:component_ref rois:code="navigation"/><rois:arguments>${argument}</rois:arguments></rois:command_unit_list>`;
  assert.match(await said_over_http(client, 'execute', `<rois:CommandUnitSequence>${far}</rois:CommandUnitSequence>`), /return_code="OK"/);
  await until_ended_elsewhere(client, 'far');
  // Reading marks them as sent; thirty of these are kept.
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

behind_a_proxy('a silently dead link is dropped', { heartbeat: 500 }, async (client, proxy, seen) => {
  const resumed = seen.until('resumed');
  proxy.half_open();
  await resumed;
  assert.deepEqual(seen.states, ['lost', 'resumed']);
  // The same during a call.
  const again = seen.until('resumed');
  proxy.half_open();
  assert.equal((await client.search()).length, 15);
  await again;
});

behind_a_proxy('a silent gateway that answers pings keeps its link', { heartbeat: 500 }, async (client, _, seen) => {
  while (seen.out.filter((name) => name === 'connect').length < 3) await client.notifications().next(10);
  assert.deepEqual(seen.states, []);
});

behind_a_proxy('every call ends with its deadline', { deadline: 1000 }, async (client, proxy, seen) => {
  proxy.refuses = true;
  proxy.cut();
  await seen.until('lost');
  await assert.rejects(client.search(), { failure: 'deadline', message: /^no answer within 1000 ms: \w/ });
  await assert.rejects(client.search(undefined, { deadline: 1 }), { message: /^no answer within 1 ms: \w/ });
  await assert.rejects(client.execute([command('move', 'start')], { deadline: 20 }), { failure: 'deadline' });
  proxy.refuses = false;
  await seen.until('resumed');
  assert.deepEqual(seen.out.filter((name) => name !== 'resume'), [], 'expired calls are not sent');
});

behind_a_proxy('a call may have no deadline', { deadline: Infinity }, async (client, proxy) => {
  proxy.lateness = 40;
  await client.bind('navigation');
  const targets = await client.subscribe('reached_target');
  const execution = await go(client, 0, 1);
  const event = targets.next(Infinity);
  assert.equal(await execution.status(3e9), 'OK');
  assert.equal((await event)?.event_type, 'reached_target');
});

behind_a_proxy('a call whose deadline has passed is not repeated', {}, async (client, proxy, seen) => {
  proxy.half_open();
  await assert.rejects(client.search(undefined, { deadline: 10 }), { failure: 'deadline' });
  const resumed = seen.until('resumed');
  proxy.cut();
  await resumed;
  await client.get_profile();
  assert.deepEqual(seen.out, ['search', 'resume', 'get_profile']);
});

// No link lasts long enough to send this.
behind_a_proxy('a call ends with its deadline while link after link breaks', { deadline: 300 }, async (client, proxy) => {
  const long = 'x'.repeat(100_000);
  const speech = await SpeechSynthesis.bind_any(client);
  proxy.next_cut = () => 10_000;
  proxy.cut_after_next();
  await assert.rejects(speech.say(long), { failure: 'deadline', message: /^no answer within 300 ms/ });
  await assert.rejects(client.bind_any(property('name').equals(long)), { failure: 'deadline', message: /^no answer within 300 ms/ });
  assert.ok(proxy.cuts > 2);
  proxy.next_cut = undefined;
  proxy.cut_after_next();
});

// RoIS Gateway accepts 1 MiB.
behind_a_proxy('a request that is too large fails with too_large', {}, async (client, _, seen) => {
  const speech = await SpeechSynthesis.bind_any(client);
  const long = 'x'.repeat(2_000_000);
  const too_large = { failure: 'fault', message: /^too_large: the gateway closed the link with 1009, the message is longer than max_body allows; this has 2000\d{3} bytes$/ };
  for (const call of [() => speech.say(long), () => client.bind_any(property('name').equals(long)), () => client.search(property('name').equals(long)), () => client.send(`<${long}/>`)]) {
    const [small] = await Promise.all([client.search(), assert.rejects(call(), too_large)]);
    assert.equal(small.length, 15);
  }
  assert.equal(String(await speech.say('Good day.')), 'OK');
  assert.deepEqual(seen.states, Array(4).fill(['lost', 'resumed']).flat());
  assert.deepEqual(seen.out.filter((name) => name === 'execute'), ['execute', 'execute']);
});

behind_a_proxy('an id that was used before does not make a lost command an accepted one', {}, async (client, proxy) => {
  await client.bind('navigation');
  const mine = [command('navigation', 'start', { target_position: ['4000, 5000'] }, { command_id: 'mine' })];
  assert.equal(await (await client.execute(mine)).status(5000), 'OK');
  proxy.half_open();
  await Promise.all([assert.rejects(client.execute(mine), { failure: 'link_lost' }), proxy.cut()]);
});

behind_a_proxy('an answer after the deadline does not go to another call', {}, async (client, proxy) => {
  proxy.lateness = 40;
  await assert.rejects(client.query('robot_position', undefined, { deadline: 10 }), { failure: 'deadline' });
  proxy.lateness = 0;
  assert.equal((await client.search()).length, 15);
});

behind_a_proxy('documents that arrive byte by byte are read', { heartbeat: 60_000 }, async (client, proxy, seen) => {
  proxy.drip = 1;
  const detection = await PersonDetection.bind_any(client);
  const detected = await detection.subscribe('person_detected');
  await detection.start();
  assert.equal((await detected.next(5000))!.results.number('number'), 0);
  assert.deepEqual(seen.states, []);
});

behind_a_proxy('a document that may not be repeated fails when the link breaks', {}, async (client, proxy, seen) => {
  proxy.half_open();
  const sent = client.send('<search xmlns="urn:x-rois:psm:xml:message:1"/>');
  proxy.cut();
  await assert.rejects(sent, { failure: 'link_lost' });
  if (client.state !== 'resumed') await seen.until('resumed');
  assert.equal((await client.send('<search xmlns="urn:x-rois:psm:xml:message:1"/>')).name, 'search_response');
});

// Cuts the link at every byte of an execute and its answer: it runs once.
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

// The same for bind_any: a second one would take another component. There are two robots.
async function bind_any_while_cut(dialogue: (client: Client, other: Client, bind_any: () => Promise<string>, bytes: number) => Promise<void>): Promise<void> {
  const two = await Gateway.start('--floor-plan', `${root}/components/simulation/data/two-robots.xml`, ...flags);
  const proxy = await Proxy.before(two.port);
  const [client, other] = [await connect(proxy.url, quick), await connect(two.url)];
  for (let bytes = 1; bytes < 1500; bytes += 61) {
    const bind_any = async () => {
      let left = 1;
      proxy.next_cut = () => (left-- > 0 ? bytes : Infinity);
      proxy.cut_after_next();
      const { code } = await client.bind_any('Navigation');
      assert.ok((await client.search()).length > 15); // after the cut
      return code;
    };
    await dialogue(client, other, bind_any, bytes);
  }
  await other.close();
  await client.close();
  await proxy.stop();
  await two.stop();
}

test('bind_any binds one component wherever the link is cut', () =>
  bind_any_while_cut(async (client, other, bind_any, bytes) => {
    const bound = await bind_any();
    const second = await other.bind_any('Navigation');
    assert.notEqual(second.code, bound, `${bytes}: the second component is free`);
    await other.release(second);
    await client.release(bound);
  }));

test('bind_any binds a free component wherever the link is cut', () =>
  bind_any_while_cut(async (client, other, bind_any, bytes) => {
    const first = await other.bind_any('Navigation');
    const bound = await bind_any();
    assert.notEqual(bound, first.code, `${bytes}`);
    await client.release(bound);
    await other.release(first);
  }));
