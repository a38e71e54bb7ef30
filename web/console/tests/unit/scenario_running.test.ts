// Runs of scenarios in the console: what they bind, leave and release. scenario_cases.test.ts has their states, triggers and steps.
import { beforeEach, describe, expect, test } from 'vitest';

import { type Desk, desk_of } from '../../src/scenario/desk';
import type { Console } from '../../src/state/console';
import { echo_of, end_of, history_of, units_of, world_of_cases, written } from './scenario_engine';
import { settled, type World } from './world';

let world: World;
let console: Console;
let desk: Desk;
let subscribed: number;

beforeEach(async () => {
  world = world_of_cases();
  subscribed = 0;
  world.answers.set('subscribe', () => `<subscribe_id>s-${(subscribed += 1)}</subscribe_id>`);
  world.answers.set('execute', (request) => echo_of(units_of(request)));
  console = await world.console();
  desk = desk_of(console);
});

function sequences(): string[][] {
  return world.requests.filter((one) => one.name === 'execute').map((one) => units_of(one).map(written));
}

async function tells_of_a_person(): Promise<void> {
  await world.notifies(
    'receive_event',
    '<event_id>e</event_id><event_type>person_detected</event_type><subscribe_id>s-1</subscribe_id><expire>2026-11-20T12:01:00Z</expire><component_ref rois:code="localization"/><results/>',
  );
}

// --- A scenario and its outcome ---

async function runs(states: string): Promise<void> {
  desk.open(
    'test.xml',
    `<robot_scenario xmlns="urn:x-rois:scenario:1" start="a"><component name="move"/><component name="voice" type="SpeechSynthesis"/><component name="localization"/><variable name="x"/>${states}</robot_scenario>`,
  );
  expect(desk.reading.value.problems.map(({ say }) => say())).toEqual([]);
  void desk.start();
  for (let i = 0; i < 12; ++i) await settled();
}

async function goes_on(): Promise<void> {
  for (let i = 0; i < 8; ++i) await settled();
}

const end = '<end name="z"><print>x is {x}</print></end>';

describe('a run', () => {
  test('binds all, subscribes once to each event, and releases everything', async () => {
    await runs(`<state name="a"><event type="person_detected" to="z"/><event type="person_detected" component="localization" to="z"/><event type="person_localized" to="z"/></state>${end}`);
    expect(world.names().filter((one) => /bind|subscribe/.test(one))).toEqual(['bind', 'bind_any', 'bind', 'subscribe', 'subscribe']);
    expect([...console.bindings.mine.value].sort()).toEqual(['localization', 'move', 'speech']);
    await tells_of_a_person();
    await goes_on();
    expect(history_of(desk)).toEqual(['a -> z  person_detected ', 'x is ']);
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
    expect(history_of(desk)).toEqual(['a -> b  at once']);
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
    expect(end_of(desk)).toBe('error: the session has ended, and its commands with it');
    await runs(`<state name="a"><after seconds="100" to="z"/></state>${end}`);
    await console.close();
    await goes_on();
    expect(end_of(desk)).toBe('error: the connection has closed');
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
