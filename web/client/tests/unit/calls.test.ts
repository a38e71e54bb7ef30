// Late, lost and unexpected answers, step by step, with a scripted gateway.
import assert from 'node:assert/strict';

import { type Client, command, namespaces, Navigation, type Subscription, type XmlElement } from 'rois-client';

import type { Clock } from '../kit/clock.js';
import { type Scripted, scripted } from '../kit/scripted.js';

const refs = (...codes: string[]) => {
  const list = codes.map((code) => `<component_ref xmlns:r="http://www.omg.org/spec/RoIS/20240801" r:code="${code}"/>`).join('');
  return codes.length === 1 ? list : `<component_ref_list>${list}</component_ref_list>`;
};

const go = (command_id?: string) => [command('navigation', 'start', {}, command_id === undefined ? {} : { command_id })];

// Breaks the link and opens a new one.
async function relinked(gateway: Scripted, clock: Clock): Promise<void> {
  await gateway.socket.end('cut');
  for (const tries = gateway.sockets.length; gateway.sockets.length === tries;) await clock.pass(100);
  await gateway.socket.open();
}

// Breaks the link and resumes the session.
async function again(gateway: Scripted, clock: Clock): Promise<void> {
  await relinked(gateway, clock);
  await gateway.socket.answer();
}

// Loses the session and begins a new one.
async function anew(gateway: Scripted, clock: Clock, session = 'two'): Promise<void> {
  await relinked(gateway, clock);
  await gateway.socket.fault('no_session');
  await gateway.socket.answer(`<session>${session}</session>`);
}

async function subscribed(client: Client, gateway: Scripted, event_type: string, subscribe_id: string): Promise<Subscription> {
  const subscribing = client.subscribe(event_type);
  await gateway.socket.answer(`<subscribe_id>${subscribe_id}</subscribe_id>`);
  return subscribing;
}

// --- Commands ---

scripted('a command that was not accepted before the link broke is repeated, and its end is reported', {}, async (client, gateway, clock) => {
  const executing = client.execute(go());
  const sent = gateway.socket.came[1]!;
  await again(gateway, clock);
  assert.deepEqual(gateway.socket.names, ['resume', 'get_command_result']);
  await gateway.socket.answer('', 'BAD_PARAMETER');
  assert.deepEqual(gateway.socket.names, ['resume', 'get_command_result', 'execute']);
  await gateway.socket.answer();
  const execution = await executing;
  assert.ok(sent.name === 'execute' && gateway.socket.came[1]!.text_of('command_id') === execution.command_ids[0]);
  await gateway.socket.completed(1, execution.command_ids[0], 'ABORT');
  assert.equal(await execution.status(), 'ABORT');
});

// The first execute reached the engine only after the client had looked it up.
scripted('a repeated command that is refused may have been accepted the first time', {}, async (client, gateway, clock) => {
  const executing = client.execute(go());
  await again(gateway, clock);
  await gateway.socket.answer('', 'BAD_PARAMETER');
  await gateway.socket.answer('', 'BAD_PARAMETER');
  assert.deepEqual(gateway.socket.names.slice(2), ['execute', 'get_command_result']);
  await gateway.socket.answer();
  assert.equal((await executing).command_ids.length, 1);
});

scripted('a command that is refused twice is reported as refused', {}, async (client, gateway, clock) => {
  const outcome = assert.rejects(client.execute(go()), { failure: 'refused', return_code: 'OUT_OF_RESOURCES' });
  await again(gateway, clock);
  await gateway.socket.answer('', 'BAD_PARAMETER');
  await gateway.socket.answer('', 'OUT_OF_RESOURCES');
  await gateway.socket.answer('', 'BAD_PARAMETER');
  await outcome;
  assert.deepEqual(gateway.socket.names.slice(1), ['get_command_result', 'execute', 'get_command_result']);
});

scripted('a command that is refused at first is not looked up', {}, async (client, gateway) => {
  const outcome = assert.rejects(client.execute(go()), { failure: 'refused' });
  await gateway.socket.answer('', 'ERROR');
  await outcome;
  assert.deepEqual(gateway.socket.names, ['connect', 'execute']);
});

scripted('the deadline of a call covers all of its requests', {}, async (client, gateway, clock) => {
  const outcome = assert.rejects(client.execute(go(), { deadline: 1000 }), { failure: 'deadline' });
  await clock.pass(600);
  await again(gateway, clock);
  await clock.pass(299);
  assert.deepEqual(gateway.socket.names, ['resume', 'get_command_result']);
  await clock.pass(1);
  await outcome;
  await gateway.socket.answer('', 'BAD_PARAMETER');
  assert.deepEqual(gateway.socket.names, ['resume', 'get_command_result'], 'the call has ended');
});

for (const [what, call] of [
  ['execute', (client: Client) => client.execute(go())],
  ['bind_any', (client: Client) => client.bind_any('Navigation')],
] as const)
  scripted(`${what} without a deadline uses the default for all of its requests`, { deadline: 1000 }, async (client, gateway, clock) => {
    const outcome = assert.rejects(call(client), { failure: 'deadline', message: 'no answer within 1000 ms' });
    await clock.pass(600);
    await again(gateway, clock);
    await clock.pass(300);
    await outcome;
  });

scripted('a running command keeps its end when its id is used again', {}, async (client, gateway) => {
  const executing = client.execute(go('mine'));
  await gateway.socket.answer();
  const execution = await executing;
  const outcome = assert.rejects(client.execute(go('mine')), { failure: 'refused' });
  await gateway.socket.answer('', 'BAD_PARAMETER');
  await outcome;
  await gateway.socket.completed(1, 'mine');
  assert.equal(await execution.status(), 'OK');
});

scripted('a new session has no used ids', {}, async (client, gateway, clock) => {
  const executing = client.execute(go('mine'));
  await gateway.socket.answer();
  const before = await executing;
  await anew(gateway, clock);
  await assert.rejects(before.status(), { failure: 'session_lost' });
  const next = client.execute(go('mine'));
  await again(gateway, clock);
  assert.deepEqual(gateway.socket.names, ['resume', 'get_command_result'], 'the id counts as new');
  await gateway.socket.answer();
  const after = await next;
  await gateway.socket.completed(1, 'mine');
  assert.equal(await after.status(), 'OK');
});

scripted('the status of an execution is that of its first command that is not OK', {}, async (client, gateway, clock) => {
  const executing = client.execute(['a', 'b', 'c'].flatMap(go));
  await gateway.socket.answer();
  const execution = await executing;
  for (const [i, status] of ['OK', 'TIMEOUT', 'ABORT'].entries()) await gateway.socket.completed(i + 1, 'abc'[i], status);
  const waits = clock.waits;
  assert.deepEqual(await execution.statuses(1000), ['OK', 'TIMEOUT', 'ABORT']);
  assert.equal(clock.waits, waits);
  assert.equal(await execution.status(), 'TIMEOUT');
});

scripted('set_parameter reports its end', {}, async (client, gateway) => {
  const setting = client.set_parameter('speech_synthesis', { volume: 'loud' });
  await gateway.socket.answer('<command_id>c-1</command_id>');
  const execution = await setting;
  assert.deepEqual(execution.command_ids, ['c-1']);
  await gateway.socket.completed(1, 'c-1', 'ERROR');
  assert.equal(await execution.status(), 'ERROR');
});

// --- bind_any ---

// Loses the answer of a bind_any; then `meant` match the condition and `mine` belong to this session. Returns the next request.
async function bind_any_when(client: Client, gateway: Scripted, clock: Clock, meant: string[], mine: string[]): Promise<string | undefined> {
  const binding = client.bind_any('Navigation');
  await again(gateway, clock);
  assert.deepEqual(gateway.socket.names, ['resume', 'search', 'search']);
  await gateway.socket.answer(refs(...meant));
  await gateway.socket.answer(refs(...mine));
  const next = gateway.socket.names[3];
  if (next !== undefined) await gateway.socket.answer(refs('c'));
  assert.equal((await binding).code, next === undefined ? meant.find((one) => mine.includes(one)) : 'c');
  return next;
}

scripted('bind_any finds the component that it bound when the answer was lost', {}, async (client, gateway, clock) => {
  assert.equal(await bind_any_when(client, gateway, clock, ['a', 'b', 'c'], ['x', 'b']), undefined);
});

scripted('bind_any is repeated when it has bound nothing', {}, async (client, gateway, clock) => {
  assert.equal(await bind_any_when(client, gateway, clock, ['a', 'b', 'c'], ['x', 'y']), 'bind_any');
});

scripted('bind_any does not return a component that was bound before', {}, async (client, gateway, clock) => {
  for (const [binding, answer] of [[client.bind('a'), ''], [client.bind_any('Navigation'), refs('b')]] as const) {
    await gateway.socket.answer(answer);
    await binding;
  }
  assert.equal(await bind_any_when(client, gateway, clock, ['a', 'b', 'c'], ['a', 'b']), 'bind_any');
});

scripted('bind_any may return a released component', {}, async (client, gateway, clock) => {
  for (const call of [client.bind('a'), client.release('a')]) {
    await gateway.socket.answer();
    await call;
  }
  assert.equal(await bind_any_when(client, gateway, clock, ['a', 'b'], ['a', 'x']), undefined);
});

// --- Bindings in a new session ---

async function bound(client: Client, gateway: Scripted, ...refs: string[]): Promise<void> {
  for (const ref of refs) {
    const binding = client.bind(ref);
    await gateway.socket.answer();
    await binding;
  }
}

const refs_of = (came: XmlElement[]) => came.map((one) => one.child('component_ref')?.attribute('code', namespaces.rois));

scripted('a new session binds again before all other calls', {}, async (client, gateway, clock) => {
  await bound(client, gateway, 'a', 'b');
  const subscription = await subscribed(client, gateway, 'a', 's-1');
  await gateway.socket.end('cut');
  await clock.pass(100);
  await gateway.socket.open();
  await gateway.socket.fault('no_session');
  const found = client.search();
  await gateway.socket.answer('<session>two</session>');
  assert.deepEqual(gateway.socket.names.slice(2), ['bind', 'bind', 'subscribe', 'search']);
  assert.deepEqual(refs_of(gateway.socket.came.slice(2, 4)), ['a', 'b']);
  for (const content of ['', '', '<subscribe_id>s-1</subscribe_id>', '']) await gateway.socket.answer(content);
  await found;
  assert.equal(subscription.ended, false);
});

scripted('when the new session is lost too, the next one binds each component once', {}, async (client, gateway, clock) => {
  await bound(client, gateway, 'a');
  await anew(gateway, clock);
  await anew(gateway, clock, 'three');
  await again(gateway, clock);
  assert.deepEqual(gateway.socket.names, ['resume', 'bind']);
  await gateway.socket.answer();
  await anew(gateway, clock, 'four');
  assert.deepEqual(gateway.socket.names, ['resume', 'connect', 'bind']);
});

scripted('a component that a new session cannot bind is reported, and not bound in the next one', {}, async (client, gateway, clock) => {
  const unbound: string[] = [];
  client.on('unbound', ({ component_ref, error }) => unbound.push(`${component_ref} ${error.failure}`));
  await bound(client, gateway, 'a', 'b', 'c');
  await anew(gateway, clock);
  await gateway.socket.answer('', 'OUT_OF_RESOURCES');
  await gateway.socket.fault('not_allowed');
  await gateway.socket.answer();
  assert.deepEqual(unbound, ['a refused', 'b fault']);
  await anew(gateway, clock, 'three');
  assert.deepEqual(refs_of(gateway.socket.came.slice(2)), ['c']);
});

scripted('a released component is not bound again', {}, async (client, gateway, clock) => {
  await bound(client, gateway, 'a', 'b');
  const releasing = assert.rejects(client.release('a'), { failure: 'session_lost' });
  await anew(gateway, clock);
  await releasing;
  assert.deepEqual(refs_of(gateway.socket.came.slice(2)), ['b']);
  const released = client.release('b'); // during the bind
  for (const _ of [1, 2]) await gateway.socket.answer();
  await released;
  await anew(gateway, clock, 'three');
  assert.deepEqual(gateway.socket.names, ['resume', 'connect']);
});

scripted('bind_any does not return a component that the new session bound again', {}, async (client, gateway, clock) => {
  await bound(client, gateway, 'a', 'b');
  await anew(gateway, clock);
  await gateway.socket.answer();
  await gateway.socket.answer('', 'OUT_OF_RESOURCES');
  assert.equal(await bind_any_when(client, gateway, clock, ['a', 'c'], ['a', 'x']), 'bind_any');
});

scripted('a new session binds again with the switching of each binding', {}, async (client, gateway, clock) => {
  const calls = [
    client.bind('a', { switching: 'abort' }),
    Navigation.bind(client, 'a', { switching: 'restart' }), // replaces it
    Navigation.bind_any(client, undefined, { switching: 'abort' }),
    client.bind('c'),
  ];
  const b = `<component_ref xmlns:rois="${namespaces.rois}" rois:code="b"/>`;
  for (const content of ['', '', b, '']) await gateway.socket.answer(content);
  await Promise.all(calls);
  const switchings = () => gateway.socket.came.slice(-4).map((one) => one.attribute('switching'));
  assert.deepEqual(switchings(), ['abort', 'restart', 'abort', undefined]);
  await anew(gateway, clock);
  assert.deepEqual(refs_of(gateway.socket.came.slice(2)), ['a', 'b', 'c']);
  assert.deepEqual(switchings().slice(1), ['restart', 'abort', undefined]);
});

scripted('each session of a client with switches requests them, and each switch is delivered', { switches: true }, async (client, gateway, clock) => {
  await anew(gateway, clock);
  for (const { came } of gateway.sockets) assert.equal(came.find((one) => one.name === 'connect')!.attribute('switches'), 'true');
  const notifications = client.notifications();
  const of = `<component_ref xmlns:rois="${namespaces.rois}" rois:code="navigation"/><from>robot1.navigation</from><to>robot2.navigation</to>`;
  await gateway.socket.say(`<switched xmlns="${namespaces.message}" sequence="1">${of}<reason>it failed</reason></switched>`);
  const switched = await notifications.next();
  assert.ok(switched?.name === 'switched');
  assert.deepEqual([switched.component_ref.code, switched.from, switched.to, switched.reason],
    ['navigation', 'robot1.navigation', 'robot2.navigation', 'it failed']);
});

scripted('with rebind false, a new session binds nothing', { rebind: false }, async (client, gateway, clock) => {
  await bound(client, gateway, 'a');
  await anew(gateway, clock);
  assert.equal(await bind_any_when(client, gateway, clock, ['a', 'b'], ['a', 'x']), undefined);
});

// --- Subscriptions ---

scripted('a new session may reuse the subscription ids of the old one', {}, async (client, gateway, clock) => {
  const [one, two] = [await subscribed(client, gateway, 'a', 's-1'), await subscribed(client, gateway, 'b', 's-2')];
  await anew(gateway, clock);
  assert.deepEqual(gateway.socket.came.slice(2).map((each) => each.text_of('event_type')), ['a', 'b']);
  for (const name of ['s-2', 's-1']) await gateway.socket.answer(`<subscribe_id>${name}</subscribe_id>`);
  for (const [i, name] of ['s-1', 's-2', 's-1'].entries()) await gateway.socket.event(i + 1, name);
  assert.deepEqual([one.subscribe_id, two.subscribe_id], ['s-2', 's-1']);
  assert.equal((await one.next())!.sequence, 2);
  for (const sequence of [1, 3]) assert.equal((await two.next())!.sequence, sequence);
  const more = [one.next(1), two.next(1)];
  await clock.pass(1);
  assert.deepEqual(await Promise.all(more), [undefined, undefined]);
});

scripted('subscribing again has no deadline', {}, async (client, gateway, clock) => {
  const subscription = await subscribed(client, gateway, 'a', 's-1');
  await anew(gateway, clock);
  await gateway.socket.end('cut');
  for (let tries = gateway.sockets.length; gateway.sockets.length < tries + 30; await gateway.socket.end('refused')) await clock.pass(1000);
  await clock.pass(1000);
  await gateway.socket.open();
  await gateway.socket.answer();
  assert.deepEqual(gateway.socket.names, ['resume', 'subscribe']);
  await gateway.socket.answer('<subscribe_id>s-9</subscribe_id>');
  await gateway.socket.event(1, 's-9');
  assert.equal((await subscription.next())!.sequence, 1);
});

scripted('when the new session is lost too, the next one subscribes each once', {}, async (client, gateway, clock) => {
  const subscription = await subscribed(client, gateway, 'a', 's-1');
  await anew(gateway, clock);
  await anew(gateway, clock, 'three');
  assert.deepEqual(gateway.socket.names, ['resume', 'connect', 'subscribe']);
  await gateway.socket.answer('<subscribe_id>s-1</subscribe_id>');
  await gateway.socket.event(1, 's-1');
  assert.equal((await subscription.next())!.sequence, 1);
});

scripted('a subscription that a new session refuses is not repeated in the next one', {}, async (client, gateway, clock) => {
  const [one, two] = [await subscribed(client, gateway, 'a', 's-1'), await subscribed(client, gateway, 'b', 's-2')];
  await anew(gateway, clock);
  await gateway.socket.answer('', 'UNSUPPORTED');
  await gateway.socket.answer('<subscribe_id>s-1</subscribe_id>');
  await assert.rejects(one.next(), { return_code: 'UNSUPPORTED' });
  await anew(gateway, clock, 'three');
  assert.deepEqual(gateway.socket.came.slice(2).map((each) => each.text_of('event_type')), ['b']);
  assert.equal(two.ended, false);
});

scripted('an unsubscribe during the loss of a session sends nothing more', {}, async (client, gateway, clock) => {
  const [one, two] = [await subscribed(client, gateway, 'a', 's-1'), await subscribed(client, gateway, 'b', 's-2')];
  const leaving = one.close();
  await anew(gateway, clock);
  await leaving;
  assert.deepEqual(gateway.socket.came.slice(2).map((each) => each.text_of('event_type')), ['b']);
  assert.equal(two.ended, false);
});

scripted('a subscription that is closed while a new session repeats it is unsubscribed there', {}, async (client, gateway, clock) => {
  const one = await subscribed(client, gateway, 'a', 's-1');
  await anew(gateway, clock);
  await one.close();
  assert.deepEqual(gateway.socket.names, ['resume', 'connect', 'subscribe']);
  await gateway.socket.answer('<subscribe_id>s-7</subscribe_id>');
  const last = gateway.socket.came.at(-1)!;
  assert.deepEqual([last.name, last.text_of('subscribe_id')], ['unsubscribe', 's-7']);
  await gateway.socket.answer('', 'ERROR'); // which is ignored
  await anew(gateway, clock, 'three');
  assert.deepEqual(gateway.socket.names, ['resume', 'connect']);
});

scripted('a refused unsubscribe rejects', {}, async (client, gateway) => {
  const one = await subscribed(client, gateway, 'a', 's-1');
  const outcome = assert.rejects(one.close(), { failure: 'refused' });
  await gateway.socket.answer('', 'ERROR');
  await outcome;
});

scripted('notification streams end when the client is closed', {}, async (client, gateway) => {
  const [stream, other] = [client.notifications(), client.notifications()];
  await gateway.socket.completed(1);
  assert.equal((await stream.next())!.sequence, 1);
  other.end();
  await gateway.socket.completed(2);
  assert.equal((await stream.next())!.sequence, 2);
  const waiting = stream.next();
  const closing = client.close();
  await gateway.socket.answer();
  await closing;
  assert.equal(await waiting, undefined);
  const read: number[] = [];
  for await (const one of other) read.push(one.sequence);
  assert.deepEqual(read, [1]);
});
