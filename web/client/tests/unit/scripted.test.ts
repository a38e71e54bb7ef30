// The link step by step, with a scripted gateway.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { Client, type ClientOptions, namespaces, Navigation, type OpenSocket } from 'rois-client';

import { Clock, settled } from '../kit/clock.js';
import { news_of, options, Scripted, scripted, type ScriptedSocket } from '../kit/scripted.js';

scripted('retries come less and less often until one succeeds', {}, async (client, gateway, clock) => {
  for (const delay of [100, 200, 400, 800, 1000, 1000]) {
    await gateway.socket.end('refused', true); // is not final for a client that had a session
    const tries = gateway.sockets.length;
    await clock.pass(delay - 1);
    assert.equal(gateway.sockets.length, tries, `${delay}`);
    await clock.pass(1);
    assert.equal(gateway.sockets.length, tries + 1, `${delay}`);
    assert.equal(client.state, 'lost');
  }
  await gateway.socket.open();
  await gateway.socket.answer();
  assert.equal(client.state, 'resumed');
});

// Expects a new link after `delay` ms and resumes on it.
async function resumed_after(delay: number, gateway: Scripted, clock: Clock): Promise<void> {
  const tries = gateway.sockets.length;
  await clock.pass(delay - 1);
  assert.equal(gateway.sockets.length, tries, `${delay}`);
  await clock.pass(1);
  assert.equal(gateway.sockets.length, tries + 1, `${delay}`);
  await gateway.socket.open();
  await gateway.socket.answer();
}

scripted('each resumed session resets the delay', {}, async (client, gateway, clock) => {
  for (let sequence = 1; sequence <= 20; ++sequence) {
    await gateway.socket.end('cut');
    await resumed_after(100, gateway, clock);
    await gateway.socket.completed(sequence);
  }
  assert.equal(client.state, 'resumed');
});

scripted('links that open but do not resume the session come less and less often', {}, async (client, gateway, clock) => {
  for (const delay of [100, 200, 400, 800, 1000]) {
    await gateway.socket.end('cut');
    const tries = gateway.sockets.length;
    await clock.pass(delay - 1);
    assert.equal(gateway.sockets.length, tries, `${delay}`);
    await clock.pass(1);
    await gateway.socket.open();
  }
  assert.equal(client.state, 'lost');
  await gateway.socket.answer();
  assert.equal(client.state, 'resumed');
});

scripted('a failed command has its reason', {}, async (client, gateway) => {
  const [bound, going] = [Navigation.bind(client, 'navigation'), new Navigation(client, 'navigation').go_to('attic')];
  await gateway.socket.answer();
  await gateway.socket.answer();
  await bound;
  await gateway.socket.completed(1, command_id_of(gateway.socket), 'ERROR');
  assert.equal(gateway.socket.names.at(-1), 'get_command_result');
  const result = (name: string, text: string) => `<result r:name="${name}" xmlns:r="${namespaces.rois}"><r:data_type_ref r:code="string"/><r:value>${text}</r:value></result>`;
  await gateway.socket.answer(`<results>${result('status', 'ERROR')}${result('reason', 'no way leads to the attic')}</results>`);
  const completion = await going;
  assert.deepEqual([completion.ok, completion.status, completion.reason], [false, 'ERROR', 'no way leads to the attic']);
  assert.equal(`${completion}`, 'ERROR: no way leads to the attic');
});

scripted('a failed command has only its status when the reason cannot be fetched', {}, async (client, gateway) => {
  const going = new Navigation(client, 'navigation').go_to('attic');
  await gateway.socket.answer();
  await gateway.socket.completed(1, command_id_of(gateway.socket), 'ABORT');
  await gateway.socket.answer('', 'BAD_PARAMETER');
  const completion = await going;
  assert.equal(`${completion}`, 'ABORT');
});

function command_id_of(socket: ScriptedSocket): string {
  const [, id] = /command_id="([^"]+)"/.exec(socket.texts.find((text) => text.startsWith('<execute'))!)!;
  return id!;
}

scripted('a request that is too large for the gateway fails, and only that one', {}, async (client, gateway, clock) => {
  const calls: Promise<unknown>[] = [client.search(), client.send(`<mine>${'日'.repeat(1000)}</mine>`), client.bind('b'.repeat(2000))];
  const outcomes = Promise.allSettled(calls);
  await gateway.socket.end('closed with 1009', false, 1009);
  await resumed_after(100, gateway, clock);
  assert.deepEqual(gateway.socket.names, ['resume', 'search', 'bind']);
  for (const _ of [1, 2]) await gateway.socket.answer();
  const [search, send, bind] = await outcomes;
  assert.deepEqual([search!.status, bind!.status], ['fulfilled', 'fulfilled']);
  assert.ok(send!.status === 'rejected');
  assert.equal(send!.reason.failure, 'fault');
  assert.deepEqual(send!.reason.fault, { code: 'too_large', reason: 'closed with 1009; this has 3013 bytes' });
});

scripted('an expired call may have been the one that was too large', {}, async (client, gateway, clock) => {
  const late = assert.rejects(client.bind('b'.repeat(2000), { deadline: 10 }), { failure: 'deadline' });
  const found = client.search();
  await clock.pass(10);
  await late;
  await gateway.socket.end('closed with 1009', false, 1009);
  await resumed_after(100, gateway, clock);
  await gateway.socket.answer();
  await found;
});

scripted('when the gateway rejects a text as not UTF-8, the oldest call fails', {}, async (client, gateway, clock) => {
  const outcome = assert.rejects(client.search(), { failure: 'fault', message: 'not_well_formed: closed with 1007' });
  const profile = client.get_profile().catch(() => undefined);
  await gateway.socket.end('closed with 1007', false, 1007);
  await outcome;
  await resumed_after(100, gateway, clock);
  assert.deepEqual(gateway.socket.names, ['resume', 'get_profile']);
  await gateway.socket.answer();
  await profile;
});

scripted('delays are shortened at random', { random: () => 0.5 }, async (_, gateway, clock) => {
  await gateway.socket.end('cut');
  await clock.pass(74);
  assert.equal(gateway.sockets.length, 1);
  await clock.pass(1);
  assert.equal(gateway.sockets.length, 2);
});

scripted('calls keep their order across a broken link', {}, async (client, gateway, clock) => {
  const calls: Promise<unknown>[] = [client.search(), client.get_profile(), client.release('a')];
  await gateway.socket.end('cut');
  calls.push(client.bind('b'));
  const outcomes = Promise.allSettled(calls);
  client.on('state', ({ state }) => state === 'resumed' && void client.send('<mine/>'));
  await clock.pass(100);
  await gateway.socket.open();
  await gateway.socket.answer();
  assert.deepEqual(gateway.socket.names, ['resume', 'search', 'get_profile', 'release', 'bind', 'mine']);
  for (const return_code of ['ERROR', 'UNSUPPORTED', 'OK', 'BAD_PARAMETER', 'OK']) await gateway.socket.answer('', return_code);
  const codes = (await outcomes).map((one) => (one.status === 'rejected' ? one.reason.return_code : 'OK'));
  assert.deepEqual(codes, ['ERROR', 'UNSUPPORTED', 'OK', 'BAD_PARAMETER']);
});

for (const [how, refuse] of [
  ['refused', (gateway: Scripted) => gateway.socket.answer('', 'BAD_PARAMETER')],
  ['answered with the fault no_session', (gateway: Scripted) => gateway.socket.fault('no_session')],
] as const)
  scripted(`when resume is ${how}, a new session begins, and counts from one`, {}, async (client, gateway, clock) => {
    const news = news_of(client);
    for (const sequence of [1, 2, 3]) await gateway.socket.completed(sequence);
    await gateway.socket.end('cut');
    await clock.pass(100);
    await gateway.socket.open();
    assert.equal(gateway.socket.came[0]!.attribute('session'), 'one');
    assert.equal(gateway.socket.came[0]!.attribute('last_sequence'), '3');
    await refuse(gateway);
    assert.equal(client.session, '');
    assert.deepEqual(gateway.socket.names, ['resume', 'connect']);
    await gateway.socket.answer('<session>two</session>');
    await gateway.socket.completed(1);
    await gateway.socket.end('cut');
    await clock.pass(100);
    await gateway.socket.open();
    assert.equal(gateway.socket.came[0]!.attribute('session'), 'two');
    assert.equal(gateway.socket.came[0]!.attribute('last_sequence'), '1');
    assert.deepEqual(news, ['1', '2', '3', 'lost', 'gap: session', 'open', '1', 'lost']);
  });

scripted('when resume fails for now, it is retried', {}, async (client, gateway, clock) => {
  await gateway.socket.end('cut');
  await clock.pass(100);
  await gateway.socket.open();
  await gateway.socket.fault('too_many');
  assert.ok(gateway.socket.closed);
  await clock.pass(200);
  await gateway.socket.open();
  assert.equal(gateway.socket.came[0]!.attribute('session'), 'one');
  await gateway.socket.answer();
  assert.equal(client.state, 'resumed');
});

// Starts a client and returns how it ended.
async function begun(more: ClientOptions, open_socket: OpenSocket, dialogue: (clock: Clock) => Promise<void>): Promise<string> {
  const clock = new Clock();
  try {
    const client = new Client('http://robot', { ...options, ...more }, open_socket);
    const states: string[] = [];
    client.on('state', ({ state }) => states.push(state));
    const outcome = client.start(15_000).then(String, String);
    await settled();
    await dialogue(clock);
    const ending = await outcome;
    assert.equal(client.state, 'closed');
    assert.equal(clock.waits, 0);
    await assert.rejects(client.search(), { failure: 'closed' });
    await client.close();
    assert.equal(clock.waits, 0);
    return `${states.join(' ')}: ${ending}`;
  } finally {
    clock.remove();
  }
}

test('a client that is refused a session retries, and reports the reason in the end', async () => {
  const gateway = new Scripted();
  const ending = await begun({}, gateway.open, async (clock) => {
    await gateway.socket.open();
    await gateway.socket.fault('too_many');
    assert.ok(gateway.socket.closed);
    await clock.pass(100);
    assert.equal(gateway.sockets.length, 2);
    await clock.pass(14_900);
  });
  assert.equal(ending, 'connecting connecting closed: RoisError: no session within 15000 ms: no session within 10000 ms');
  assert.ok(gateway.socket.closed);
});

test('each failed attempt is reported at once while the client retries', async () => {
  const gateway = new Scripted();
  const reports: string[] = [];
  await begun({ on_state: ({ state, reason }) => reports.push(`${state}: ${reason}`) }, gateway.open, async (clock) => {
    await gateway.socket.end('connection refused');
    assert.deepEqual(reports, ['connecting: connection refused']);
    await clock.pass(100);
    await gateway.socket.end('no route');
    assert.deepEqual(reports, ['connecting: connection refused', 'connecting: no route']);
    await clock.pass(14_900);
  });
});

test('an immediate failure of the socket is reported at once', async () => {
  const broken = () => {
    throw new Error('no sockets today');
  };
  assert.equal(await begun({}, broken, async () => undefined), 'closed: RoisError: Error: no sockets today');
  const gateway = new Scripted();
  assert.equal(await begun({}, gateway.open, () => gateway.socket.end('never', true)), 'closed: RoisError: never');
});

for (const [when, greeted] of [['before', false], ['just when', true]] as const)
  test(`a client that is closed ${when} there is a session closes at once`, async () => {
    const [clock, gateway] = [new Clock(), new Scripted()];
    const client = new Client('http://robot', options, gateway.open);
    const started = assert.rejects(client.start(), { failure: 'unreachable', message: 'the client was closed' });
    await gateway.socket.open();
    client.on('document', () => void client.close());
    if (greeted) await gateway.socket.answer('<session>one</session>');
    else await client.close();
    await started;
    assert.deepEqual([client.state, clock.waits, gateway.socket.closed], ['closed', 0, true]);
    clock.remove();
  });

scripted('a link that opens but is not answered is dropped', {}, async (client, gateway, clock) => {
  await gateway.socket.end('cut');
  await clock.pass(100);
  const silent = gateway.socket;
  await silent.open();
  await clock.pass(10_000);
  assert.ok(silent.closed);
  assert.equal(gateway.sockets.length, 2);
  await clock.pass(200);
  await gateway.socket.open();
  await gateway.socket.answer();
  await clock.pass(10_000);
  assert.equal(client.state, 'resumed', 'the timer of the attempt is cleared');
});

scripted('a client that is closed during a ping disconnects on the new link', {}, async (client, gateway, clock) => {
  const closing = Promise.all([client.close(), client.close()]);
  await gateway.socket.end('cut');
  await clock.pass(100);
  await gateway.socket.open();
  await gateway.socket.answer();
  assert.deepEqual(gateway.socket.names, ['resume', 'disconnect']);
  await gateway.socket.answer();
  await closing;
  assert.ok(gateway.socket.closed);
  assert.equal(client.state, 'closed');
});

scripted('a session that has already ended needs no new link to close', {}, async (client, gateway) => {
  const closing = client.close();
  await gateway.socket.fault('no_session');
  await closing;
  assert.deepEqual(gateway.socket.names, ['connect', 'disconnect']);
});

scripted('a silent gateway is pinged', {}, async (client, gateway, clock) => {
  await clock.pass(9_000);
  await gateway.socket.completed(1);
  await clock.pass(9_000);
  assert.deepEqual(gateway.socket.names, ['connect'], 'a message has arrived');
  await clock.pass(6_000);
  assert.deepEqual(gateway.socket.names, ['connect', 'connect']);
  await gateway.socket.answer('<session>one</session>');
  await clock.pass(15_000);
  assert.deepEqual(gateway.socket.names, ['connect', 'connect', 'connect'], 'once');
  await clock.pass(10_000);
  assert.equal(client.state, 'lost');
  assert.ok(gateway.sockets[0]!.closed);
});

scripted('a call waits while other messages arrive, but not for ever', { deadline: 100_000 }, async (client, gateway, clock) => {
  await clock.pass(4_000);
  const found = client.search();
  for (let sequence = 1; sequence < 4; ++sequence) {
    await clock.pass(8_000);
    await gateway.socket.completed(sequence);
  }
  assert.deepEqual([client.state, gateway.socket.names], ['open', ['connect', 'search']], 'no ping while a call is unanswered');
  await clock.pass(15_000);
  assert.equal(client.state, 'lost');
  await gateway.socket.open();
  await gateway.socket.answer();
  await gateway.socket.answer();
  assert.deepEqual(await found, []);
});

scripted('an ended session is detected by a ping', {}, async (client, gateway, clock) => {
  const news = news_of(client);
  const subscribing = client.subscribe('person_detected');
  await gateway.socket.answer('<subscribe_id>s-1</subscribe_id>');
  await subscribing;
  await gateway.socket.completed(1);
  await clock.pass(15_000);
  await gateway.socket.answer('<session>two</session>');
  assert.equal(client.session, 'two');
  assert.deepEqual(gateway.socket.names, ['connect', 'subscribe', 'connect', 'subscribe']);
  await gateway.socket.answer('<subscribe_id>s-1</subscribe_id>');
  await gateway.socket.completed(1);
  assert.deepEqual(news, ['1', 'gap: session', 'open', '1']);
});

scripted('a link without an answer to a ping is dropped', {}, async (client, gateway, clock) => {
  await clock.pass(15_000);
  await gateway.socket.fault('busy');
  assert.equal(client.state, 'lost');
});

scripted('notifications and gaps in their numbers are reported once', {}, async (client, gateway) => {
  const news = news_of(client);
  for (const sequence of [1, 1, 2, 5, 4, 6]) await gateway.socket.completed(sequence);
  await gateway.socket.say('<lost xmlns="urn:x-rois:psm:xml:message:1" sequence="9" count="3"/>');
  await gateway.socket.completed(10);
  assert.deepEqual(news, ['1', '2', 'lost 2: 3 to 4', '5', '6', 'lost 3: 7 to 9', '9', '10']);
});

const says = '<search_response xmlns="urn:x-rois:psm:xml:message:1" return_code="OK"';
for (const [what, text] of Object.entries({
  'a text that is not XML': 'Good day.',
  'an incomplete message': `<completed xmlns="urn:x-rois:psm:xml:message:1"/>`,
  'the answer to another request': `${says} request_id="r99"/>`,
  'a truncated answer': `${says}/`,
}))
  scripted(`after ${what} the link is reopened`, {}, async (client, gateway, clock) => {
    const found = client.search();
    await gateway.socket.say(text);
    assert.deepEqual([client.state, gateway.socket.closed], ['lost', true]);
    await clock.pass(100);
    await gateway.socket.open();
    await gateway.socket.answer();
    await gateway.socket.answer();
    assert.deepEqual(await found, []);
  });

scripted('after an answer without a request the link is reopened', {}, async (client, gateway) => {
  await gateway.socket.say(`${says}/>`);
  assert.equal(client.state, 'lost');
});

// A listener may do anything, also when the session is lost.
for (const [how, lose] of [
  ['a resume', async (gateway: Scripted, clock: Clock) => {
    await gateway.socket.end('cut');
    await clock.pass(100);
    await gateway.socket.open();
    await gateway.socket.fault('no_session');
  }],
  ['a ping', async (gateway: Scripted, clock: Clock) => {
    await clock.pass(15_000);
    await gateway.socket.answer('<session>two</session>');
  }],
  ['a call', (gateway: Scripted) => gateway.socket.fault('no_session')],
] as const)
  scripted(`a client that is closed when ${how} reports a lost session stays closed`, {}, async (client, gateway, clock) => {
    const news = news_of(client);
    client.on('gap', () => void client.close());
    const call = how === 'a call' ? client.search() : undefined;
    const outcome = call && assert.rejects(call, { failure: 'session_lost' });
    await lose(gateway, clock);
    await outcome;
    assert.deepEqual(news.filter((one) => one !== 'lost'), ['gap: session', 'closed']);
    assert.deepEqual([client.state, clock.waits, gateway.socket.is_over], ['closed', 0, true]);
    assert.ok(!gateway.socket.names.slice(1).includes('connect') || how === 'a ping');
  });

scripted('an answer after the deadline has no effect', { buffer: 1 }, async (client, gateway, clock) => {
  const news = news_of(client);
  const outcome = assert.rejects(client.subscribe('t', { deadline: 100 }), { failure: 'deadline' });
  await clock.pass(100);
  await outcome;
  await gateway.socket.answer('<subscribe_id>s-1</subscribe_id>');
  for (const sequence of [1, 2, 3]) await gateway.socket.event(sequence, 's-1');
  assert.deepEqual(news, ['1', '2', '3'], 'and no gap for a stream without a reader');
});

scripted('all calls of a lost session fail, and only those', {}, async (client, gateway) => {
  const calls = [client.search(), client.get_profile(), client.send('<mine/>')];
  const failed = calls.map((call) => assert.rejects(call, { failure: 'session_lost' }));
  await gateway.socket.fault('no_session');
  const next = client.search();
  for (const _ of [1, 2]) await gateway.socket.fault('no_session');
  await Promise.all(failed);
  assert.deepEqual(gateway.socket.names, ['connect', 'search', 'get_profile', 'mine', 'connect']);
  await gateway.socket.answer('<session>two</session>');
  await gateway.socket.answer();
  assert.deepEqual(await next, []);
});

// Its base64 has all characters that base64url replaces: fn5+Pj4+Pz8/w7s=
test('a token is not sent to another machine without TLS', () => {
  const unused: OpenSocket = () => assert.fail('nothing is opened');
  for (const url of ['http://robot', 'ws://192.0.2.1:8080', 'http://127.0.0.1.example'])
    assert.throws(() => new Client(url, { token: 't' }, unused), { failure: 'invalid', message: /^a token is not sent to '.+' without TLS/ });
  for (const url of ['https://robot', 'wss://192.0.2.1', 'http://localhost:8080', 'ws://127.0.0.1', 'http://[::1]:1']) new Client(url, { token: 't' }, unused);
});

scripted('a token is encoded as base64url', { token: '~~~>>>???û' }, async (_, gateway) => {
  assert.deepEqual(gateway.socket.subprotocols, ['rois.xml.v1', 'rois.bearer.fn5-Pj4-Pz8_w7s']);
});
