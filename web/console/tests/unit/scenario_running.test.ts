// Running scenarios: states, triggers and steps as in docs/rois-command.md.
import type { XmlElement } from 'rois-client';
import { beforeEach, describe, expect, test } from 'vitest';

import { type Desk, desk_of } from '../../src/scenario/desk';
import { Trouble } from '../../src/scenario/trouble';
import type { Console } from '../../src/state/console';
import { profile_xml, settled, World } from './world';

const argument = (name: string, type: string) => `<rois:Arguments rois:name="${name}"><rois:data_type_ref rois:code="${type}"/></rois:Arguments>`;
const message = (kind: string, name: string, inside = '') => `<rois:MessageProfile xsi:type="rois:${kind}MessageProfileType" rois:name="${name}">${inside}</rois:MessageProfile>`;

let world: World;
let console: Console;
let desk: Desk;
let subscribed: number;

beforeEach(async () => {
  world = new World();
  subscribed = 0;
  world.answers.set('get_profile', () =>
    profile_xml({
      move: { type: 'Move', messages: message('Command', 'start', argument('line', 'int[]') + argument('time', 'int')) },
      speech: { type: 'SpeechSynthesis', messages: message('Command', 'start', argument('speech_text', 'string')) },
      localization: { type: 'PersonLocalization', messages: message('Event', 'person_localized') + message('Event', 'person_detected') },
      system: { type: 'SystemInformation', messages: message('Query', 'robot_position') },
    }),
  );
  world.answers.set('bind_any', () => '<component_ref rois:code="speech"/>');
  world.answers.set('subscribe', () => `<subscribe_id>s-${(subscribed += 1)}</subscribe_id>`);
  world.answers.set('query', () => `<component_ref rois:code="system"/><results>${result('position_data', '1000, 2000, 90')}</results>`);
  world.answers.set('get_command_result', () => `<results>${result('status', 'RUNNING')}</results>`);
  world.answers.set('execute', echo);
  world.pages.set('/rois/map', { status: 404, text: '' });
  console = await world.console();
  desk = desk_of(console);
});

function result(name: string, ...values: string[]): string {
  return `<result rois:name="${name}"><rois:data_type_ref rois:code="string[]"/>${values.map((one) => `<rois:value>${one}</rois:value>`).join('')}</result>`;
}

const attribute_of = (element: XmlElement, name: string) => element.attributes.find((one) => one.name === name)?.value ?? '';

function echo(request: XmlElement): string {
  const units = request.child('CommandUnitSequence')!.children.map(
    (unit) =>
      `<rois:command_unit_list xsi:type="rois:CommandMessageType" rois:command_type="${attribute_of(unit, 'command_type')}" rois:command_id="${attribute_of(unit, 'command_id')}"><rois:component_ref rois:code="${attribute_of(unit.child('component_ref')!, 'code')}"/></rois:command_unit_list>`,
  );
  return `<rois:CommandUnitSequence>${units.join('')}</rois:CommandUnitSequence>`;
}

// --- Sent commands: `move.start(line=1 2)` ---

function sequences(): string[][] {
  return world.requests
    .filter((one) => one.name === 'execute')
    .map((one) =>
      one.child('CommandUnitSequence')!.children.map((unit) => {
        const given = (unit.child('arguments')?.children ?? []).map((each) => `${attribute_of(each, 'name')}=${each.all('value').map((value) => value.text).join('|')}`);
        return `${attribute_of(unit.child('component_ref')!, 'code')}.${attribute_of(unit, 'command_type')}(${given.join(', ')})`;
      }),
    );
}

async function completes(status = 'OK', nth = -1): Promise<void> {
  const ids = world.requests.filter((one) => one.name === 'execute').flatMap((one) => one.child('CommandUnitSequence')!.children.map((unit) => attribute_of(unit, 'command_id')));
  await world.notifies('completed', `<command_id>${ids.at(nth)}</command_id><status>${status}</status>`);
}

async function tells(event_type: string, results: string, id = 's-1'): Promise<void> {
  await world.notifies(
    'receive_event',
    `<event_id>e</event_id><event_type>${event_type}</event_type><subscribe_id>${id}</subscribe_id><expire>2026-11-20T12:01:00Z</expire><component_ref rois:code="localization"/><results>${results}</results>`,
  );
}

// --- A scenario and its outcome ---

async function runs(states: string, start = 'a', variables = '<variable name="x"/><variable name="y">7</variable><variable name="list"/>'): Promise<void> {
  desk.open(
    'test.xml',
    `<robot_scenario xmlns="urn:x-rois:scenario:1" start="${start}"><component name="move"/><component name="voice" type="SpeechSynthesis"/><component name="localization"/>${variables}${states}</robot_scenario>`,
  );
  expect(desk.reading.value.problems.map(({ say }) => say())).toEqual([]);
  void desk.start();
  for (let i = 0; i < 12; ++i) await settled();
}

function history(): string[] {
  return desk.history.list().map((one) => (one.kind === 'print' ? one.line : `${one.from} -> ${one.to}  ${one.by}`));
}

function variable(name: string): string {
  return desk.run!.variables.get(name)!.join(', ');
}

async function goes_on(): Promise<void> {
  for (let i = 0; i < 8; ++i) await settled();
}

function trouble(): string {
  const { outcome } = desk.run!;
  if (outcome?.how !== 'trouble') return outcome?.how ?? 'runs';
  return outcome.trouble instanceof Trouble ? outcome.trouble.say() : String(outcome.trouble);
}

const end = '<end name="z"><print>x is {x}</print></end>';

describe('a run', () => {
  test('binds all, subscribes once to each event, and releases everything', async () => {
    await runs(`<state name="a"><event type="person_detected" to="z"/><event type="person_detected" component="localization" to="z"/><event type="person_localized" to="z"/></state>${end}`);
    expect(world.names().filter((one) => /bind|subscribe/.test(one))).toEqual(['bind', 'bind_any', 'bind', 'subscribe', 'subscribe']);
    expect([...console.bindings.mine.value].sort()).toEqual(['localization', 'move', 'speech']);
    await tells('person_detected', result('number', '1'));
    await goes_on();
    expect(history()).toEqual(['a -> z  person_detected number=1', 'x is ']);
    expect(desk.run!.outcome).toEqual({ how: 'ended', state: 'z' });
    expect([...console.bindings.mine.value]).toEqual([]);
    expect(world.names().filter((one) => one === 'unsubscribe')).toHaveLength(2);
    expect(desk.is_running.value).toBe(false);
  });

  test('leaves earlier bindings, and stops its commands there', async () => {
    await console.bindings.bind('move');
    await runs(`<state name="a"><command component="move" type="start"/><after seconds="100" to="z"/></state>${end}`);
    desk.stop();
    await goes_on();
    expect(desk.run!.outcome).toEqual({ how: 'stopped' });
    expect([...console.bindings.mine.value]).toEqual(['move']);
    expect(sequences()).toEqual([['move.start()'], ['move.stop()']]);
  });

  test('leaves alone components that other parts of the page use', async () => {
    const give_back = await console.bindings.borrow(['move']);
    await runs(`<state name="a"><command component="move" type="start"/><after seconds="100" to="z"/></state>${end}`);
    desk.stop();
    await goes_on();
    expect(sequences()).toEqual([['move.start()']]);
    expect([...console.bindings.mine.value]).toEqual(['move']);
    await give_back();
    expect([...console.bindings.mine.value]).toEqual([]);
  });

  test('that ends in a state marked failed has failed', async () => {
    await runs('<state name="a"><at_once to="b"/></state><end name="b" failed="true"/>');
    expect(desk.run!.outcome).toEqual({ how: 'failed', state: 'b' });
    expect(history()).toEqual(['a -> b  at once']);
  });

  test('cannot be edited while it runs, and undo works afterwards', async () => {
    await runs(`<state name="a"><after seconds="100" to="z"/></state>${end}`);
    const text = desk.text.value;
    desk.edit('other', 'x');
    expect(desk.text.value).toBe(text);
    desk.stop();
    await goes_on();
    desk.edit(`${text} `, 'field');
    desk.edit(`${text}  `, 'field');
    desk.undo();
    expect(desk.text.value).toBe(text);
    expect(world.remembered.get('scenario')).toBe(text);
  });

  test('ends with the session and with the connection', async () => {
    await runs(`<state name="a"><after seconds="100" to="z"/></state>${end}`);
    world.answers.set('resume', () => 'ERROR');
    world.breaks();
    await world.tries_again();
    await world.opens();
    await goes_on();
    expect(trouble()).toBe('The session has ended, and its commands with it.');
    await runs(`<state name="a"><after seconds="100" to="z"/></state>${end}`);
    await console.close();
    await goes_on();
    expect(trouble()).toBe('The connection has closed.');
  });

  test('that loops can be stopped', async () => {
    await runs('<state name="a"><at_once to="b"/></state><state name="b"><at_once to="a"/></state>');
    await goes_on();
    expect(desk.run!.visits.get('a')).toBe(50);
    desk.stop();
    await world.passes(0);
    await goes_on();
    expect(desk.run!.outcome).toEqual({ how: 'stopped' });
  });
});

describe('a state', () => {
  test('does its actions, sends its commands as one sequence, then queries; the answer triggers before anything else', async () => {
    await runs(
      `<state name="a"><set variable="x">12</set><command component="move" type="start"><argument name="line">{x} {y}</argument><argument name="line">3</argument></command>` +
        `<command component="voice" type="start"><argument name="speech_text">{x}!</argument></command><query type="robot_position"/>` +
        `<at_once to="z"/><answered to="z"><take variable="x" result="position_data"/></answered></state>${end}`,
    );
    expect(sequences()[0]).toEqual(['move.start(line=12 7 3)', 'speech.start(speech_text=12!)']);
    expect(world.names().indexOf('execute')).toBeLessThan(world.names().indexOf('query'));
    expect(history()).toEqual(['a -> z  answered', 'x is 1000, 2000, 90']);
  });

  test('sends its leaving commands, and the next state waits for their end', async () => {
    await runs(
      `<state name="a"><event type="person_detected" to="b"/><leaving><command component="move" type="stop"/></leaving></state>` +
        `<state name="b"><event type="person_detected" to="z"/></state>${end}`,
    );
    await tells('person_detected', result('number', '1'));
    expect(sequences()).toEqual([['move.stop()']]);
    expect(desk.run).toMatchObject({ state: 'a', is_leaving: true });
    await tells('person_detected', result('number', '2')); // arrived before b was entered: not a trigger there
    await completes();
    await goes_on();
    expect(desk.run).toMatchObject({ state: 'b', is_leaving: false });
    await tells('person_detected', result('number', '3'));
    await goes_on();
    expect(history()).toEqual(['a -> b  person_detected number=1', 'b -> z  person_detected number=3', 'x is ']);
  });

  test('ends the scenario when its commands end without a trigger for it, unless an event or a time may trigger', async () => {
    const command = '<command component="move" type="start"/>';
    await runs(`<state name="a">${command}<completed status="OK" to="z"/></state>${end}`);
    await completes('ERROR');
    await goes_on();
    expect(trouble()).toBe("The commands of 'a' ended with ERROR, and no trigger is for that.");
    await runs(`<state name="a">${command}<completed status="OK" to="z"/><after seconds="5" to="z"/></state>${end}`);
    await completes('ERROR');
    await goes_on();
    expect(trouble()).toBe('runs');
    await world.passes(5000);
    await goes_on();
    expect(history()).toEqual(['a -> z  after 5 s', 'x is ']);
  });
});

describe('a trigger', () => {
  test('completed waits for all commands and gets the first status that is not OK', async () => {
    const two = '<command component="move" type="start"/><command component="voice" type="start"/>';
    await runs(`<state name="a">${two}<completed status="OK" to="b"/><completed status="ABORT" to="z"/></state><end name="b"/>${end}`);
    await completes('ABORT', 0);
    expect(history()).toEqual([]);
    await completes('ERROR', 1);
    await goes_on();
    expect(history()).toEqual(['a -> z  completed ABORT', 'x is ']);
  });

  test('after fires once in a state at its time, whether its conditions hold or not', async () => {
    await runs(
      `<state name="a"><after seconds="1" to="z"><when variable="x" is="1"/></after><after seconds="{y}" to="z"/><event type="person_detected" to="a"><set variable="x">1</set></event></state>${end}`,
    );
    await world.passes(1000);
    await goes_on();
    expect(history()).toEqual([]);
    await tells('person_detected', '');
    await goes_on();
    expect(desk.run!.visits.get('a')).toBe(2);
    await world.passes(1000);
    await goes_on();
    expect(history()).toEqual(['a -> a  person_detected ', 'a -> z  after 1 s', 'x is 1']);
  });

  test('requires a number of seconds', async () => {
    await runs(`<state name="a"><after seconds="{x}" to="z"/></state>${end}`);
    expect(trouble()).toBe("a: '' is not a number of seconds");
  });

  test('takes events only of the named component and of its own subscriptions', async () => {
    await runs(`<state name="a"><event type="person_detected" component="move" to="b"/><event type="person_detected" component="localization" to="z"/></state><end name="b"/>${end}`);
    await tells('person_detected', '', 's-77');
    await goes_on();
    expect(history()).toEqual([]);
    await tells('person_detected', '');
    await goes_on();
    expect(history()).toEqual(['a -> z  person_detected ', 'x is ']);
  });

  test('fires when all its steps hold in order; the first in the document is taken, and failed attempts are undone', async () => {
    await runs(
      `<state name="a"><at_once to="b"><set variable="x">5</set><when variable="x" is_not="5"/></at_once><at_once to="z"><when variable="x" empty="true"/><count variable="y"/></at_once></state><end name="b"/>${end}`,
    );
    expect(history()).toEqual(['a -> z  at once', 'x is ']);
    expect(variable('y')).toBe('8');
  });
});

describe('steps', () => {
  const seen = (steps: string) => `<state name="a"><event type="person_localized" to="z">${steps}</event><after seconds="9" to="b"/></state><end name="b"/>${end}`;
  const people = result('person_ref', 'p1', 'p2', 'p3') + result('position_data', '0, 0, 0', '1000, 0, 90', '4000, 0, 0');

  test.each([
    ['the first', '<take variable="x" result="person_ref"/>', 'p1'],
    ['case-insensitive', '<take variable="x" result="Person_Ref"/>', 'p1'],
    ['not in a list', '<add variable="list">p1</add><add variable="list">p2</add><take variable="x" result="person_ref" not_in="list"/>', 'p3'],
    ['apart from places', '<add variable="list">0, 0, 0</add><take variable="x" result="position_data" not_in="list" apart="1500"/>', '4000, 0, 0'],
    ['beside another result', '<take variable="x" result="person_ref" beside="position_data" is="1000, 0, 90"/>', 'p2'],
    ['in front of a person', '<set variable="y">1000, 0, 90</set><place variable="x" before="{y}" distance="500"/>', '1000, 500, 270'],
    ['to their left', '<place variable="x" before="0, 0" distance="1000" turn="90"/>', '0, 1000, 270'],
    ['counted', '<set variable="x">abc</set><count variable="x"/><count variable="x"/>', '2'],
    ['a list', '<add variable="x">1</add><add variable="x">{y}</add>', '1, 7'],
  ])('%s', async (_, steps, expected) => {
    await runs(seen(steps));
    await tells('person_localized', people);
    await goes_on();
    expect([trouble(), variable('x')]).toEqual(['ended', expected]);
  });

  test.each([
    ['is', '<when variable="y" is="7"/>', true],
    ['is filled', '<set variable="x">7</set><when variable="y" is="{x}"/>', true],
    ['is not', '<when variable="y" is_not="7"/>', false],
    ['in', '<add variable="list">7</add><when variable="y" in="list"/>', true],
    ['in nothing', '<when variable="x" in="list"/>', false],
    ['not in', '<when variable="y" not_in="list"/>', true],
    ['empty', '<when variable="x" empty="true"/>', true],
    ['not empty', '<when variable="x" empty="false"/>', false],
    ['near', '<set variable="x">0, 0</set><when variable="x" near="300, 400, 0" within="500"/>', true],
    ['not near', '<set variable="x">0, 0</set><when variable="x" near="300, 400, 0" within="499"/>', false],
    ['near, and nowhere', '<when variable="x" near="300, 400, 0" within="500"/>', false],
    ['a result that is not there', '<take variable="x" result="face_ref"/>', false],
    ['a list that has nothing else', '<add variable="list">p1</add><take variable="x" result="person_ref" not_in="list"/><set variable="x"/><take variable="x" result="person_ref" beside="position_data" is="?"/>', false],
  ])('hold or fail: %s', async (_, steps, holds) => {
    await runs(seen(steps));
    await tells('person_localized', people);
    await goes_on();
    expect(history().length > 0).toBe(holds);
  });

  test('an invalid place ends the scenario', async () => {
    await runs(seen('<place variable="x" before="{y}" distance="1"/>'));
    await tells('person_localized', people);
    await goes_on();
    expect(trouble()).toBe('\'7\' is not a place: expected "x, y, th"');
  });

  test('arguments are validated before sending', async () => {
    await runs(`<state name="a"><command component="move" type="start"><argument name="line">{y} far</argument></command><after seconds="1" to="z"/></state>${end}`);
    expect(trouble()).toBe("line: 'far' is not of the type int[]");
    await runs(`<state name="a"><command component="move" type="start"><argument name="width">1</argument></command><after seconds="1" to="z"/></state>${end}`);
    expect(trouble()).toBe("move has no argument 'width'; it has line, time");
    expect(sequences()).toEqual([]);
  });
});
