// Every operation, with the real gateway.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';

import {
  all_of,
  any_of,
  AudioStreaming,
  box,
  type Client,
  command,
  Component,
  component_ref,
  component_type,
  concurrently,
  type Condition,
  connect,
  delay,
  distance,
  everything,
  Follow,
  in_parallel,
  type Located,
  Move,
  Navigation,
  not,
  PersonDetection,
  point,
  property,
  Reaction,
  RoisError,
  sequentially,
  SpeechRecognition,
  SpeechSynthesis,
  SystemInformation,
  value,
  WrittenCondition,
} from 'rois-client';

import { Gateway, root } from '../kit/gateway.js';

let gateway: Gateway;
let client: Client;

before(async () => {
  gateway = await Gateway.start('--media', '127.0.0.1:0', '--scenario', `${root}/tests/server/data/one_visitor.xml`, '--sim-speed', '100', '--seed', '7');
});
after(() => gateway.stop());

// Runs each test in a session of its own.
function spoken(name: string, dialogue: () => Promise<void>): void {
  test(name, async () => {
    client = await connect(gateway.url);
    try {
      await dialogue();
    } finally {
      await client.close();
    }
  });
}

const refused = (return_code: string) => (error: unknown) => error instanceof RoisError && error.failure === 'refused' && error.return_code === return_code;

spoken('a session begins and ends', async () => {
  assert.equal(client.state, 'open');
  assert.match(client.session, /\S{16}/);
  await client.close();
  assert.equal(client.state, 'closed');
  await assert.rejects(client.search(), { failure: 'closed' });
});

spoken('get_profile returns the whole profile', async () => {
  const profile = await client.get_profile();
  assert.equal(profile.engine.name, 'reception');
  assert.deepEqual(
    profile.components.map((one) => one.ref).sort(),
    profile.engine.sub_engines.flatMap((one) => one.components).sort(),
  );
  assert.deepEqual([profile.engine.components, profile.engine.sub_engines.map((one) => one.name)], [[], ['robot1']]);
  const navigation = profile.component_profiles.find((one) => one.id === 'profile.navigation')!;
  assert.equal(navigation.identifier, 'urn:x-rois:def:component:OMG::Navigation');
  assert.equal(navigation.name, 'navigation');
  const reached = navigation.messages.find((one) => one.name === 'reached_target')!;
  assert.equal(reached.kind, 'event');
  assert.deepEqual(reached.results.map((one) => [one.name, one.data_type_ref.code]), [['target', 'string'], ['is_final_target', 'bool']]);
  const set = navigation.messages.find((one) => one.name === 'set_parameter')!;
  assert.equal(set.arguments.find((one) => one.name === 'routing_policy')!.default_value, 'time');
  assert.ok(navigation.parameters.length >= 3);
  const few = await client.get_profile(component_type('Navigation'));
  assert.deepEqual(few.components, [{ ref: 'navigation', type: 'urn:x-rois:def:component:OMG::Navigation', engine: 'robot1' }]);
});

spoken('components are found, bound and released', async () => {
  const found = await client.search(component_type('Navigation'));
  assert.deepEqual(found.map((one) => one.code), ['navigation']);
  assert.equal(found[0]!.codebook_ref, 'urn:x-rois:def:component:OMG::Navigation');
  await client.bind(found[0]!);
  const other = await connect(gateway.url);
  await assert.rejects(other.bind('navigation'), refused('OUT_OF_RESOURCES'));
  await assert.rejects(other.bind_any('Navigation'), refused('OUT_OF_RESOURCES'));
  assert.equal(await new Navigation(other, 'navigation').component_status(), 'BUSY');
  await client.release('navigation');
  assert.equal((await other.bind_any('Navigation')).code, 'navigation');
  await other.close();
  await assert.rejects(client.bind('elevator'), { failure: 'refused', return_code: 'BAD_PARAMETER', message: /elevator/ });
});

spoken('parameters are set and read', async () => {
  const speech = await SpeechSynthesis.bind_any(client);
  assert.equal(String(await speech.set({ speech_text: 'Good & <morning>', volume: 70 })), 'OK');
  const parameters = await speech.get();
  assert.equal(parameters.text('speech_text'), 'Good & <morning>');
  assert.equal(parameters.number('volume'), 70);
  assert.ok(parameters.texts('synthesizable_languages').includes('en'));
  await assert.rejects(speech.set({ volume: 'loud' }), refused('BAD_PARAMETER'));
});

spoken('commands run in sequence and in parallel, and each ends once', async () => {
  await client.bind('speech_synthesis');
  await client.bind('reaction');
  const ends: string[] = [];
  client.on('notification', (one) => one.name === 'completed' && ends.push(one.command_id));
  const say = (text: string, command_id: string) => command('speech_synthesis', 'start', { speech_text: text }, { command_id });
  const bow = (command_id: string) => command('reaction', 'start', { reaction_ref: value.identifier('9') }, { command_id, delay_time: 1 });
  const execution = await client.execute([
    say('One.', '1'),
    delay(1),
    concurrently(say('Two.', '2'), [bow('3'), bow('4')]),
    in_parallel(sequentially(bow('5'), bow('6')), say('Three.', '7')),
  ]);
  assert.deepEqual(execution.command_ids, ['1', '2', '3', '4', '5', '6', '7']);
  assert.deepEqual(await execution.statuses(5000), Array(7).fill('OK'));
  assert.equal(await execution.status(), 'OK');
  assert.deepEqual([...ends].sort(), ['1', '2', '3', '4', '5', '6', '7']);
  assert.equal((await client.get_command_result('4')).text('status'), 'OK');
  await assert.rejects(client.execute([bow('4')]), refused('BAD_PARAMETER'));
  await assert.rejects(client.execute([command('navigation', 'start')]), refused('ERROR'));
});

spoken('waiting for an execution ends with the deadline', async () => {
  const follow = await Follow.bind_any(client);
  const execution = await client.execute([command('follow', 'start', { target_object_ref: value.identifier('nobody'), distance: 500 })]);
  await assert.rejects(execution.status(10), { failure: 'deadline' });
  assert.equal(String(await follow.stop()), 'OK');
  assert.equal(await execution.status(), 'OK');
});

spoken('the component classes send the right commands', async () => {
  const [navigation, speech, reaction] = [await Navigation.bind_any(client), await SpeechSynthesis.bind_any(client), await Reaction.bind(client, 'reaction')];
  const [move, listening] = [await Move.bind_any(client), await SpeechRecognition.bind_any(client)];
  const system = new SystemInformation(client, 'system_information');
  const targets = await navigation.subscribe('reached_target', property('is_final_target').equals(true));
  assert.equal(String(await navigation.go_to([{ x: 5000, y: 6000, th: 0 }, '6000, 6000'], { time_limit: 90_000, routing_policy: 'distance' })), 'OK');
  assert.equal((await targets.next(1000))!.results.text('target'), '6000, 6000');
  assert.equal(await targets.next(1), undefined);
  const [at] = await system.robot_position();
  assert.ok(Math.hypot(at!.x - 6000, at!.y - 6000) < 200, JSON.stringify(at));
  assert.equal(await system.engine_status(), 'READY');
  assert.equal(String(await speech.say('Good day.', { volume: 20, language: 'en' })), 'OK');
  assert.equal(String(await speech.say_ssml('<speak version="1.0" xml:lang="en">Hello.</speak>')), 'OK');
  assert.equal(String(await reaction.react(9)), 'OK');
  assert.equal(String(await move.line(100, 0)), 'OK');
  assert.equal(String(await move.curve(500, 10, { time: 200 })), 'OK');
  assert.equal(String(await listening.listen({ languages: ['en'] })), 'OK');
  assert.equal(String(await listening.stop()), 'OK');
  const idle = await navigation.suspend();
  assert.equal(idle.status, 'ERROR', 'nothing is running');
  assert.notEqual(idle.reason, '');
  const unreachable = await navigation.go_to({ x: -5000, y: -5000, th: 0 });
  assert.equal(unreachable.status, 'ERROR');
  assert.notEqual(unreachable.reason, '');
  assert.equal(await navigation.component_status(), 'READY');
  await navigation.release();
  await assert.rejects(navigation.stop(), refused('ERROR'));
});

spoken('numbers are rounded where RoIS expects whole ones', async () => {
  const [navigation, speech, move] = [await Navigation.bind_any(client), await SpeechSynthesis.bind_any(client), await Move.bind_any(client)];
  const follow = await Follow.bind_any(client);
  assert.equal(String(await navigation.go_to('6000.5, 6000', { time_limit: 90_000.5 })), 'OK');
  assert.equal(String(await speech.say('Good day.', { volume: 20.4 })), 'OK');
  assert.equal(String(await speech.say_ssml('<speak version="1.0" xml:lang="en">Hello.</speak>', { volume: 60.6 })), 'OK');
  assert.equal((await speech.get()).text('volume'), '61');
  assert.equal(String(await move.line(99.5, 0.4, { time: 1000.5 })), 'OK');
  assert.equal(String(await move.curve(500.5, 10.4, { time: 1000.5 })), 'OK');
  const following = follow.follow('nobody', 500.5, { time_limit: 90_000.5 });
  assert.equal(String(await follow.stop()), 'OK');
  assert.equal(String(await following), 'OK');
  const timed = [command('speech_synthesis', 'start', { speech_text: 'Then.' }, { delay_time: 0.6 }), delay(1.5), concurrently(command('move', 'stop'))];
  assert.equal(await (await client.execute(timed)).status(), 'OK');
});

spoken('connect_stream returns the address of the stream', async () => {
  const audio = await AudioStreaming.bind_any(client);
  const changes = await audio.subscribe('notify_stream_status');
  const stream = await audio.connect_stream();
  assert.match(stream.text('transport_parameters') ?? '', /^http:/);
  const id = stream.text('stream_id')!;
  assert.equal((await changes.next(5000))!.results.text('stream_id'), id);
  assert.equal(String(await audio.suspend_stream(id)), 'OK');
  assert.equal(String(await audio.resume_stream(id)), 'OK');
  assert.equal(String(await audio.disconnect_stream(id)), 'OK');
});

spoken('bind_any chooses the first free component of the order', async () => {
  const navigation = await Navigation.bind_any(client, property('status').equals('READY').sorted_by(distance('location', 'desk')));
  assert.equal(navigation.component_ref instanceof Object && navigation.component_ref.code, 'navigation');
  await assert.rejects(Move.bind_any(client, property('name').equals('nobody')), refused('UNSUPPORTED'));
});

spoken('events reach their subscribers, and their details can be fetched', async () => {
  const detection = await PersonDetection.bind_any(client);
  const inline = await detection.subscribe('person_detected', property('number').at_least(0));
  const bare = await client.subscribe('person_detected', { inline_results: false });
  const all = client.notifications();
  await detection.start();
  const event = (await inline.next(5000))!;
  const same = (await bare.next(5000))!;
  assert.equal(event.event_type, 'person_detected');
  assert.equal(event.component_ref.code, 'person_detection');
  assert.ok(event.results.number('number')! >= 0);
  assert.ok(event.results.time('timestamp')! < event.expire);
  assert.deepEqual(same.results.parameters, []);
  assert.notEqual(same.subscribe_id, event.subscribe_id);
  assert.equal((await client.get_event_detail(same.event_id)).number('number'), event.results.number('number'));
  assert.equal((await all.next(1000))!.sequence, 1);
  await inline.close();
  await bare.close();
  assert.equal(String(await detection.stop()), 'OK');
  await detection.start();
  for (let one = await inline.next(100); one; one = await inline.next(100)) assert.fail('an event after unsubscribe');
});

spoken('equal subscriptions share an id, and only the last unsubscribes', async () => {
  const out: string[] = [];
  client.on('document', ({ direction, text }) => direction === 'out' && out.push(text));
  const [one, two] = await Promise.all([client.subscribe('person_detected'), client.subscribe('person_detected')]);
  assert.equal(one.subscribe_id, two.subscribe_id);
  const detection = await PersonDetection.bind_any(client);
  await detection.start();
  assert.equal((await one.next(5000))!.sequence, (await two.next(5000))!.sequence);
  await one.close();
  await detection.stop();
  await detection.start();
  assert.ok(await two.next(5000));
  assert.equal(out.filter((text) => text.includes('<unsubscribe')).length, 0);
  await two.close();
  await two.close();
  assert.equal(out.filter((text) => text.includes('<unsubscribe')).length, 1);
});

spoken('a query names the component that answered', async () => {
  const { component_ref: who, results } = await client.query('robot_position');
  assert.equal(who.code, 'system_information');
  assert.equal(results.poses('position_data').length, 1);
  const located: Located = results.located[0]!;
  assert.equal(located.of, 'position_data');
  assert.equal((await client.query('component_status', component_ref('move'))).results.text('status'), 'READY');
  await assert.rejects(client.query('fortune'), refused('UNSUPPORTED'));
});

spoken('error details can be fetched', async () => {
  await assert.rejects(client.get_error_detail('e-none'), refused('BAD_PARAMETER'));
});

// The engine accepts each of them: otherwise it answers BAD_PARAMETER with a reason.
const now = new Date();
const conditions: Record<string, Condition> = {
  component_type: component_type('navigation'),
  component_ref: component_ref('navigation'),
  differs: property('status').differs_from('ERROR'),
  less: property('Property/time_limit').less_than(100),
  at_most: property('Property/time_limit').at_most(100, { match_action: 'All' }),
  at_least: property('Property/time_limit').at_least(-5),
  between: property('Property/time_limit').between(0, 60_000),
  like: property('name').like('nav*', { match_case: false }),
  without_case: property('name').equals('NAVIGATION', { match_case: false }),
  null: property('Property/target_position').is_null(),
  within_a_place: property('location').within('desk'),
  within_a_box: property('location').within(box({ x: 0, y: 0 }, { x: 50_000, y: 50_000 })),
  intersects: property('location').intersects(box({ x: 0, y: 0 }, { x: 50_000, y: 50_000 })),
  disjoint: property('location').disjoint_from('desk'),
  near: property('location').no_farther_than(1500, point(0, 0)),
  far: property('location').farther_than(1500, point(0, 0)),
  distance: all_of(component_type('Navigation'), not(property('bound').equals(true))).sorted_by(distance('location', point(0, 0)), 'DESC').sorted_by('name'),
  order_alone: everything.sorted_by('name'),
  any_of: any_of(component_ref('move'), component_ref('navigation'), property('name').like('\\**')),
  all_of_one: all_of(component_ref('move'), everything),
  escaped: property('name').equals('<&>"'),
};
spoken('conditions of all kinds are accepted', async () => {
  const found: Record<string, number> = {};
  for (const [name, condition] of Object.entries(conditions)) found[name] = (await client.search(condition)).length;
  const all = (await client.search()).length;
  assert.equal(all, 17);
  for (const name of ['component_type', 'component_ref', 'without_case', 'distance', 'all_of_one']) assert.equal(found[name], 1, name);
  for (const name of ['differs', 'order_alone', 'within_a_box', 'intersects', 'far']) assert.equal(found[name], all, name);
  for (const name of ['near', 'within_a_place', 'escaped']) assert.equal(found[name], 0, name);
  assert.equal(found['any_of'], 2);
  assert.ok(found['like']! >= 1 && found['disjoint'] === all);
  const written = new WrittenCondition('<unr:SearchCondition><unr:ComponentCondition type="Move"/></unr:SearchCondition>');
  assert.deepEqual((await client.search(written)).map((one) => one.code), ['move']);
  const yesterday = new Date(now.getTime() - 86_400_000);
  for (const condition of [property('timestamp').after(yesterday), property('timestamp').before(now), property('timestamp').during(yesterday, now)])
    await (await client.subscribe('person_detected', { condition })).close();
});

spoken('send takes any document and returns the answer unchanged', async () => {
  const seen: string[] = [];
  client.on('document', ({ direction, text }) => seen.push(`${direction} ${text}`));
  const mine = '<search  xmlns="urn:x-rois:psm:xml:message:1" request_id="mine"/>';
  const [answer, fault] = await Promise.all([client.send(mine), client.send('<sear')]);
  assert.equal(answer.name, 'search_response');
  assert.equal(answer.attribute('request_id'), 'mine');
  assert.equal(fault.name, 'fault');
  assert.equal(fault.attribute('code'), 'not_well_formed');
  assert.equal(seen[0], `out ${mine}`);
  assert.equal(seen.filter((text) => text.startsWith('in ')).length, 2);
  await assert.rejects(client.send('<r:resume xmlns:r="urn:x-rois:psm:xml:message:1" session="x" last_sequence="0"/>'), { failure: 'invalid' });
  await client.send('<disconnect xmlns="urn:x-rois:psm:xml:message:1"/>');
  assert.equal(client.state, 'closed');
});

spoken('characters that XML does not allow are not sent', async () => {
  await assert.rejects(client.bind('\u0001'), { failure: 'invalid' });
  await assert.rejects(client.execute([command('move', 'start', { line: '\uD800' })]), (error: Error) => error.message.includes('U+D800'));
  assert.equal((await client.search()).length, 17);
});

spoken('waiting callers are rejected when the client is closed', async () => {
  const subscription = await client.subscribe('person_detected');
  const stream = client.notifications();
  const listener: string[] = [];
  client.on('state', ({ state }) => listener.push(state));
  await Component.bind(client, 'follow');
  const execution = await client.execute([command('follow', 'start', { target_object_ref: value.identifier('nobody'), distance: 500 })]);
  const waiting = [subscription.next(), stream.next()];
  await client.close();
  assert.equal(await waiting[0], undefined);
  assert.equal((await waiting[1])?.name, 'completed');
  assert.equal(await execution.status(), 'ABORT', 'the end of the session aborts it, and the client receives that');
  for await (const _ of subscription) assert.fail();
  assert.deepEqual(listener, ['closed']);
});

test('an unreachable gateway is reported', async () => {
  await assert.rejects(connect('http://127.0.0.1:1', { deadline: 1000, first_delay: 10 }), { failure: 'unreachable', message: /no session within 1000 ms: .*ECONNREFUSED/ });
  await assert.rejects(connect(`${gateway.url}/elsewhere`), { failure: 'unreachable', message: /404/ });
  await assert.rejects(connect('ftp://robot'), { failure: 'invalid' });
  await assert.rejects(connect('robot'), { failure: 'invalid' });
});

test('a token is sent with the handshake', async () => {
  const mine = await connect(`${gateway.url.replace('http', 'ws')}/rois`, { token: 'ö/+ secret?' });
  await mine.close();
});
