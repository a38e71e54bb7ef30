// State and operations, with a scripted engine.
import { command, request, text_element, type XmlElement } from 'rois-client';
import { beforeEach, describe, expect, test, vi } from 'vitest';

import type { Console } from '../../src/state/console';
import { profile_xml, settled, World } from './world';

const event = '<rois:MessageProfile xsi:type="rois:EventMessageProfileType" rois:name="person_localized"/>';
let world: World;
let console: Console;

beforeEach(async () => {
  world = new World();
  world.answers.set('get_profile', () => profile_xml({ navigation: { type: 'Navigation' }, person_localization: { type: 'PersonLocalization', messages: event } }));
  world.answers.set('get_command_result', () => result('status', 'RUNNING'));
  world.answers.set('execute', echo);
  world.pages.set('/rois/map', { status: 404, text: '' });
  console = await world.console();
});

function result(name: string, ...values: string[]): string {
  const texts = values.map((one) => `<rois:value>${one}</rois:value>`).join('');
  return `<results><result rois:name="${name}"><rois:data_type_ref rois:code="string"/>${texts}</result></results>`;
}

function echo(request: XmlElement): string {
  const units = request.child('CommandUnitSequence')!.children.map((unit) => {
    const of = (name: string) => unit.attributes.find((one) => one.name === name)?.value ?? '';
    return `<rois:command_unit_list xsi:type="rois:CommandMessageType" rois:command_type="${of('command_type')}" rois:command_id="${of('command_id')}"><rois:component_ref rois:code="${unit.child('component_ref')!.attributes[0]!.value}"/></rois:command_unit_list>`;
  });
  return `<rois:CommandUnitSequence>${units.join('')}</rois:CommandUnitSequence>`;
}

function localized(...people: [ref: string, x: number, y: number][]): string {
  const located = people.map(([ref, x, y]) => `<located of="position_data" ref="${ref}" crs="hall"><position>${x} ${y} 0</position><orientation>0 0 90</orientation><covariance>2500 0 0 0 900 0 0 0 4</covariance></located>`);
  return `<event_id>e</event_id><event_type>person_localized</event_type><subscribe_id>s-1</subscribe_id><expire>2026-11-20T12:01:00Z</expire><component_ref rois:code="person_localization"/><results><result rois:name="person_ref"><rois:data_type_ref rois:code="RoISIdentifier[]" rois:codebook_ref="tracks"/></result>${located.join('')}</results>`;
}

describe('the link', () => {
  test('opens with a session, and fetches the profile', () => {
    expect(console.link.view.value.phase).toBe('open');
    expect(console.link.session.value).toBe('session-1');
    expect(console.profile.components.value.map((one) => one.ref)).toEqual(['navigation', 'person_localization']);
    expect(console.map.view.value).toEqual({ state: 'none' });
  });

  test('is lost when it breaks, and resumes the session', async () => {
    world.breaks();
    expect(console.link.view.value).toMatchObject({ phase: 'lost', reason: 'the WebSocket was closed with 1006' });
    await world.tries_again();
    await world.opens();
    expect(console.link.view.value.phase).toBe('resumed');
  });

  test.each([
    [503, 'draining'],
    [429, 'refused'],
    [403, 'refused'],
    [426, 'lost'],
  ])('a gateway that answers %i makes it %s', async (status, phase) => {
    world.pages.set('/rois', { status, text: '<fault code="x"><reason>so it is</reason></fault>' });
    world.breaks();
    await settled();
    expect(console.link.view.value.phase).toBe(phase);
    if (phase !== 'lost') expect(console.link.view.value.reason).toBe('so it is');
  });

  test('a gateway that shuts down gives the reason when it closes', () => {
    world.breaks('the WebSocket was closed with 1001, shutting down');
    expect(console.link.view.value.phase).toBe('draining');
  });

  test('a gateway that shuts down is lost as soon as it is gone', async () => {
    world.pages.set('/rois', { status: 503, text: '<fault code="shutting_down"><reason>so it is</reason></fault>' });
    world.breaks('the WebSocket was closed with 1001, shutting down');
    await settled();
    expect(console.link.view.value.phase).toBe('draining');
    await world.tries_again();
    world.breaks();
    await settled();
    expect(console.link.view.value).toMatchObject({ phase: 'draining', reason: 'so it is' });
    world.pages.clear();
    await world.tries_again();
    world.breaks();
    await settled();
    expect(console.link.view.value.phase).toBe('lost');
  });

  test('that is lost is retried at once on request, without polling meanwhile', async () => {
    const stop = console.metrics.poll.watch();
    world.breaks();
    await settled();
    const fetched = vi.spyOn(world, 'fetch');
    await world.passes(10_000);
    expect(fetched).not.toHaveBeenCalled();
    const tried = world.tries_again();
    console.retry();
    await tried;
    await world.opens();
    expect(console.link.view.value.phase).toBe('resumed');
    expect(fetched.mock.calls.map(([path]) => path)).toContain('/metrics');
    console.retry(); // has no effect
    expect(console.link.view.value.phase).toBe('resumed');
    stop();
  });

  test('nothing remains of a session that the user has ended', async () => {
    await console.bindings.bind('navigation');
    await world.notifies('receive_event', localized(['a', 1, 2]));
    await console.close();
    expect(console.link.view.value.phase).toBe('closed');
    expect([console.bindings.mine.value.size, console.entities.all.size, console.robots.all.size, console.status.all.value.size]).toEqual([0, 0, 0, 0]);
    expect(console.metrics.latest.value).toBeUndefined();
  });

  test('a gateway that refused and is gone then is lost', async () => {
    world.pages.set('/rois', { status: 429, text: '<fault code="too_many"><reason>so it is</reason></fault>' });
    world.breaks();
    await settled();
    expect(console.link.view.value.phase).toBe('refused');
    world.pages.clear();
    await world.tries_again();
    world.breaks();
    await settled();
    expect(console.link.view.value.phase).toBe('lost');
  });

  test('asks for a token if the gateway requires one, and connects with it', async () => {
    const shy = new World();
    shy.pages.set('/rois', { status: 401, text: '<fault code="unauthorized"><reason>no token</reason></fault>' });
    const { Console: Made } = await import('../../src/state/console');
    const closed = new Made(shy);
    closed.connect();
    shy.breaks();
    await settled();
    expect(closed.link.view.value.phase).toBe('token');
    shy.pages.clear();
    closed.connect('a secret');
    await shy.opens();
    expect(closed.link.view.value.phase).toBe('open');
    expect(closed.current_token).toBe('a secret');
  });

  test('sends no token without TLS', async () => {
    const open_to_all = new World();
    open_to_all.origin = 'http://engine.example';
    const { Console: Made } = await import('../../src/state/console');
    const closed = new Made(open_to_all);
    closed.connect('a secret');
    expect(closed.link.view.value).toMatchObject({ phase: 'token', reason: expect.stringContaining("not sent to 'engine.example' without TLS") });
    expect(closed.current_token).toBeUndefined();
  });

  test('a gap is shown until it is acknowledged', async () => {
    await world.notifies('profile_changed');
    world.says('<profile_changed xmlns="urn:x-rois:psm:xml:message:1" sequence="5"/>');
    await settled();
    expect(console.link.missed.value?.gap).toEqual({ reason: 'lost', count: 3, first: 2, last: 4 });
    expect(console.events.gaps.size).toBe(1);
    console.link.forget_missed();
    expect(console.link.missed.value).toBeUndefined();
  });
});

describe('documents', () => {
  test('answers have their request and their time', async () => {
    await console.client.search();
    const answer = console.documents.ring.last!;
    expect(answer).toMatchObject({ direction: 'in', kind: 'answer', name: 'search_response', return_code: 'OK', took: 0, is_own: false });
    expect(answer.request?.name).toBe('search');
  });

  test("the console's own requests are marked", () => {
    const asked = console.documents.ring.list().filter((one) => one.name === 'get_profile');
    expect(asked.map((one) => one.is_own)).toEqual([true]);
  });

  test('changes are notified once a frame', async () => {
    world.draws();
    const before = console.events.pulse.beat.value;
    for (let i = 0; i < 5; ++i) await world.notifies('receive_event', localized(['a', i, 0]));
    expect(console.events.pulse.beat.value).toBe(before);
    world.draws();
    expect(console.events.pulse.beat.value).toBe(before + 1);
  });

  test('a text is sent unchanged, and its answer is found', async () => {
    const { answer, document } = await console.send('<search xmlns="urn:x-rois:psm:xml:message:1"/>');
    expect(answer.name).toBe('search_response');
    expect(document?.request?.text).toBe('<search xmlns="urn:x-rois:psm:xml:message:1"/>');
  });
});

describe('commands', () => {
  test('bind their components, run, and end', async () => {
    const { command_ids, ends } = await console.run('navigation', 'start', { target_position: ['desk'] });
    expect(world.names().slice(-2)).not.toContain('release');
    expect(console.bindings.holder_of('navigation')).toEqual({ who: 'me' });
    const entry = console.commands.find(command_ids[0]!)!;
    await settled();
    expect(entry).toMatchObject({ component: 'navigation', command_type: 'start', state: 'running', path: 'command_unit_list[1]' });
    await world.notifies('completed', `<command_id>${entry.id}</command_id><status>OK</status>`);
    expect(await ends).toEqual(['OK']);
    expect(entry.state).toBe('OK');
    expect(console.commands.open()).toEqual([]);
  });

  test('components bound for them are released when they have ended', async () => {
    const { command_ids, ends } = await console.run('navigation', 'start', {}, { give_back: true });
    await world.notifies('completed', `<command_id>${command_ids[0]}</command_id><status>ABORT</status>`);
    await ends;
    await settled();
    expect(world.names()).toContain('release');
    expect(console.bindings.mine.value.size).toBe(0);
  });

  test('a component that the user has bound is not released', async () => {
    await console.bindings.bind('navigation');
    const { command_ids, ends } = await console.run('navigation', 'start', {}, { give_back: true });
    await world.notifies('completed', `<command_id>${command_ids[0]}</command_id><status>OK</status>`);
    await ends;
    await settled();
    expect(world.names()).not.toContain('release');
  });

  test('two borrowers at once release once', async () => {
    const [one, other] = await Promise.all([console.bindings.borrow(['navigation']), console.bindings.borrow(['navigation'])]);
    await one();
    expect(world.names()).not.toContain('release');
    await other();
    expect(world.names().filter((name) => name === 'release')).toHaveLength(1);
  });

  test('a component borrowed during its release is bound again', async () => {
    const giving = (await console.bindings.borrow(['navigation']))();
    await console.bindings.borrow(['navigation']);
    await giving;
    expect(world.names().filter((name) => /^(bind|release)$/.test(name))).toEqual(['bind', 'release', 'bind']);
    expect(console.bindings.mine.value).toContain('navigation');
  });

  test('nothing is bound if one cannot be', async () => {
    world.answers.set('bind', (request) => (request.child('component_ref')!.attributes[0]!.value === 'move' ? 'OUT_OF_RESOURCES' : ''));
    await expect(console.execute([command('navigation', 'start'), command('move', 'start')], { give_back: true })).rejects.toMatchObject({ return_code: 'OUT_OF_RESOURCES' });
    expect(console.bindings.mine.value.size).toBe(0);
    expect(world.names()).not.toContain('execute');
  });

  test('results of a failed command are fetched automatically', async () => {
    const { command_ids } = await console.run('navigation', 'start');
    world.answers.set('get_command_result', () => result('status', 'ERROR'));
    await world.notifies('completed', `<command_id>${command_ids[0]}</command_id><status>ERROR</status>`);
    await settled();
    expect(console.commands.find(command_ids[0]!)?.results?.text('status')).toBe('ERROR');
  });

  test('detection and localization continue after start has completed; driving does not', async () => {
    for (const ref of ['navigation', 'person_localization']) {
      const { command_ids } = await console.run(ref, 'start');
      await world.notifies('completed', `<command_id>${command_ids[0]}</command_id><status>OK</status>`);
    }
    expect(console.commands.goes_on('navigation')).toBe(false);
    expect(console.commands.goes_on('person_localization')).toBe(true);
    const { command_ids } = await console.run('person_localization', 'stop');
    await world.notifies('completed', `<command_id>${command_ids[0]}</command_id><status>OK</status>`);
    expect(console.commands.goes_on('person_localization')).toBe(false);
  });

  test('a lost session makes them unknown', async () => {
    const { command_ids, ends } = await console.run('navigation', 'start');
    const entry = console.commands.find(command_ids[0]!)!;
    world.answers.set('resume', () => 'ERROR');
    world.breaks();
    await world.tries_again();
    await world.opens();
    await expect(ends).rejects.toMatchObject({ failure: 'session_lost' });
    expect(console.link.session.value).toBe('session-2');
    expect(console.link.missed.value?.gap).toEqual({ reason: 'session' });
    expect(entry.state).toBe('unknown');
    expect(console.bindings.mine.value.size).toBe(0);
  });
});

describe('people', () => {
  test('are subscribed to while watched', async () => {
    world.answers.set('subscribe', () => '<subscribe_id>s-1</subscribe_id>');
    const stop = console.entities.watch();
    await settled();
    expect([...console.subscriptions.all.value.values()].map((one) => one.event_type)).toEqual(['person_localized']);
    stop();
    await settled();
    expect(console.subscriptions.all.value.size).toBe(0);
  });

  test('are known from events without watchers, also in a new session', async () => {
    let next = 1;
    world.answers.set('subscribe', () => `<subscribe_id>s-${next++}</subscribe_id>`);
    console.entities.watch();
    await settled();
    const is_own = async (id: string) => {
      await world.notifies('receive_event', localized(['person-1', 0, 0]).replace('s-1', id));
      return console.documents.ring.last!.is_own;
    };
    expect(await is_own('s-1')).toBe(true);
    await console.subscribe('person_localized');
    expect(await is_own('s-2')).toBe(false);
    world.answers.set('resume', () => 'ERROR');
    world.breaks();
    await world.tries_again();
    await world.opens();
    expect([await is_own('s-3'), await is_own('s-4')]).toEqual([true, false]);
    await console.subscriptions.unsubscribe('s-4');
    expect([...console.subscriptions.all.value.keys()]).toEqual(['s-3']);
  });

  // The engine identifies subscriptions by type and condition, and the last inline_results counts (decision 20).
  describe('while the user has the same subscription', () => {
    const asked_with = (name: string) => world.requests.filter((one) => one.name === name).map((one) => [one.attribute('inline_results'), one.children.some(({ name }) => name === 'condition')]);

    beforeEach(async () => {
      world.answers.set('subscribe', (request) => `<subscribe_id>${request.children.some(({ name }) => name === 'condition') ? 'own' : 'theirs'}</subscribe_id>`);
      console.entities.watch();
      await settled();
    });

    test('without results, the console has its own subscription with results', async () => {
      await console.subscribe('person_localized', { inline_results: false });
      expect(asked_with('subscribe').filter(([, has_condition]) => has_condition).every(([inline]) => inline === 'true')).toBe(true);
      expect(console.subscriptions.all.value.get('own')!.inline_results).toBe(true);
      expect(console.subscriptions.all.value.get('theirs')!.inline_results).toBe(false);
      expect([console.subscriptions.is_own('own'), console.subscriptions.is_own('theirs')]).toEqual([true, false]);
      await console.subscriptions.unsubscribe('theirs');
      expect([...console.subscriptions.all.value.keys()]).toEqual(['own']);
    });

    test('by a document with the same condition and without results, the console requests results again', async () => {
      const [first] = world.requests.filter((one) => one.name === 'subscribe');
      const before = asked_with('subscribe').length;
      await console.send(request('subscribe', { inline_results: false }, text_element('event_type', first!.text_of('event_type')) + '<condition/>'));
      await settled();
      expect(asked_with('subscribe').slice(before)).toEqual([['false', true], ['true', true]]);
      expect(console.subscriptions.all.value.get('own')!.inline_results).toBe(true);
      expect(console.entities.is_blind()).toBe(false);
    });

    test('and unsubscribes that id by a document, the console subscribes again', async () => {
      const before = asked_with('subscribe').length;
      world.answers.set('subscribe', () => '<subscribe_id>another</subscribe_id>');
      await console.send(request('unsubscribe', {}, text_element('subscribe_id', 'own')));
      await settled();
      expect(asked_with('subscribe').length).toBe(before + 1);
      expect([...console.subscriptions.all.value.keys()]).toEqual(['another']);
      expect([console.subscriptions.is_own('own'), console.subscriptions.is_own('another')]).toEqual([false, true]);
      expect(console.entities.is_blind()).toBe(false);
    });
  });

  test('have a trail that starts again after an unknown path', async () => {
    for (const [x, ms] of [[1000, 100], [1500, 9000], [2000, 100], [5000, 3000], [5500, 0]] as const) {
      await world.notifies('receive_event', localized(['a', x, 0]));
      await world.passes(ms);
    }
    const trail = console.entities.all.get('person a')!.trail.list();
    expect(trail.map(({ x, begins }) => [x, begins])).toEqual([[1000, undefined], [1500, undefined], [2000, undefined], [5000, undefined], [5500, undefined]]);
    await world.passes(3000);
    await world.notifies('receive_event', localized(['a', 9000, 0]));
    expect(console.entities.all.get('person a')!.trail.at(-1)).toMatchObject({ x: 9000, begins: true });
  });

  test('have a position, a trail and a certainty, and go out of sight', async () => {
    await world.notifies('receive_event', localized(['person-1', 1000, 2000], ['person-2', 0, 0]));
    await world.notifies('receive_event', localized(['person-1', 1500, 2000]));
    const one = console.entities.all.get('person person-1')!;
    expect(one).toMatchObject({ x: 1500, y: 2000, th: 90, is_seen: true, codebook: 'tracks', crs: 'hall' });
    expect(one.trail.list().map(({ x }) => x)).toEqual([1000, 1500]);
    expect(console.entities.all.get('person person-2')!.is_seen).toBe(false);
  });

  test('get the identity of an identified person at their place', async () => {
    await world.notifies('receive_event', localized(['person-1', 1000, 2000], ['person-2', 0, 0]));
    const identified = `<event_id>f</event_id><event_type>person_identified</event_type><subscribe_id>s-2</subscribe_id><expire>2026-11-20T12:01:00Z</expire><component_ref rois:code="person_identification"/><results><result rois:name="person_ref"><rois:data_type_ref rois:code="RoISIdentifier[]" rois:codebook_ref="visitors"/><rois:value>ms-a</rois:value></result><located of="person_ref" ref="ms-a" crs="hall"><position>1100 2050 0</position></located></results>`;
    await world.notifies('receive_event', identified);
    expect(console.entities.all.get('person person-1')!.identity).toMatchObject({ ref: 'ms-a', codebook: 'visitors' });
    expect(console.entities.all.get('person person-2')!.identity).toBeUndefined();
  });
});

describe('polls', () => {
  test('the status of each component is polled while watched', async () => {
    world.answers.set('query', () => `<component_ref rois:code="navigation"/>${result('status', 'READY')}`);
    const stop = console.status.poll.watch();
    await settled();
    expect(console.status.of('navigation')).toMatchObject({ status: 'READY' });
    const asked = world.names().length;
    await world.passes(1000);
    expect(world.names().length).toBe(asked + 2);
    stop();
    await world.passes(5000);
    expect(world.names().length).toBe(asked + 2);
  });

  test('owners are known from the metrics', async () => {
    world.pages.set('/metrics', { status: 200, text: '# HELP x\nrois_component_bound{component_ref="move",session="3"} 1\nrois_sessions 2\n' });
    const stop = console.metrics.poll.watch();
    await settled();
    expect(console.bindings.holder_of('move')).toEqual({ who: 'other', session: '3' });
    expect(console.metrics.latest.value?.value('rois_sessions')).toBe(2);
    await console.bindings.bind('move');
    await console.bindings.release('move'); // it was bound by this session
    expect(console.bindings.holder_of('move')).toEqual({ who: 'nobody' });
    await world.passes(2000);
    expect(console.bindings.holder_of('move')).toEqual({ who: 'other', session: '3' });
    stop();
  });
});
