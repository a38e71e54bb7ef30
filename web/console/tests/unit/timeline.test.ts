// The time line without drawing: layout, hit tests, keys and range.
import { type ReceiveEvent, Results, type Switched } from 'rois-client';
import { beforeEach, describe, expect, test } from 'vitest';

import { Ring } from '../../src/state/base/ring';
import type { Console } from '../../src/state/console';
import type { Span } from '../../src/state/history';
import type { CommandEntry, CommandState } from '../../src/state/session/commands_state';
import type { EventEntry } from '../../src/state/session/events_state';
import type { GapEntry } from '../../src/state/session/events_state';
import { describe as describe_thing, sentence } from '../../src/timeline/describe';
import { clusters, lay_out, type Layout, next_thing, type Placed, rows_of, thing_at } from '../../src/timeline/layout';
import { end_of, first_since, oldest_of, type Sources, stopped_sources } from '../../src/timeline/sources';
import { type Mark, marks_tone, opened_by } from '../../src/timeline/things';
import { TimeView, within, zoomed } from '../../src/timeline/view';
import { time_marks, value_marks } from '../../src/ui/drawing/scales';
import { profile_xml, settled, World } from './world';

function ring<T>(...entries: T[]): Ring<T> {
  const made = new Ring<T>(10_000);
  for (const one of entries) made.push(one);
  return made;
}

let next = 0;
function event(at: number, component = 'person_detection', event_type = 'person_detected'): EventEntry {
  const received = { name: 'receive_event', event_type, component_ref: { code: component }, results: new Results(), expire: new Date(at + 60_000) } as unknown as ReceiveEvent;
  return { number: next++, at, event: received, document: 0, details: { state: 'none' } };
}
function command(component: string, sent_at: number, started_at?: number, ended_at?: number, state: CommandState = ended_at === undefined ? 'running' : 'OK'): CommandEntry {
  const sequence = { number: next++, units: [], commands: [], sent_at, document: 0 };
  const entry: CommandEntry = { id: `c${next++}`, component, command_type: 'start', arguments: [], path: '', sequence, state, sent_at };
  if (started_at !== undefined) entry.started_at = started_at;
  if (ended_at !== undefined) entry.ended_at = ended_at;
  return entry;
}
function span(kind: Span['kind'], ref: string, value: string, from: number, to: number): Span {
  return { number: next++, kind, ref, value, from, to, note: '' };
}
function sources(some: Partial<Sources> = {}): Sources {
  return { at: 100_000, refs: ['follow', 'navigation', 'person_detection'], commands: ring(), events: ring(), own_events: ring(), errors: ring(), switches: ring(), gaps: ring(), refused: ring(), past: ring(), present: [], ...some };
}
const range = { from: 40_000, to: 100_000 };
const wide = { width: 600, hides_quiet: false, with_own: false }; // 100 ms per pixel

const lanes_of = ({ lanes }: Layout) => lanes.map(({ kind, ref }) => ref || kind);
const boxes = ({ placed }: Layout, kind: string) => placed.filter((one) => one.thing.kind === kind).map(({ box }) => [box.x, box.x + box.width]);

describe('lanes', () => {
  test('are the link, commands, events and each component', () => {
    const layout = lay_out(sources(), range, wide);
    expect(lanes_of(layout)).toEqual(['link', 'commands', 'events', 'follow', 'navigation', 'person_detection']);
    expect(layout.height).toBe(layout.lanes.at(-1)!.y + layout.lanes.at(-1)!.height);
  });

  test('of quiet components can be hidden', () => {
    const present = [span('status', 'follow', 'READY', 0, 100_000), span('status', 'navigation', 'WARNING', 0, 100_000)];
    const layout = lay_out(sources({ present, events: ring(event(70_000)) }), range, { ...wide, hides_quiet: true });
    expect(lanes_of(layout)).toEqual(['link', 'commands', 'events', 'navigation', 'person_detection']);
  });

  test('of commands are as many as run at once', () => {
    const commands = ring(command('a', 1000, 1000, 5000), command('b', 2000, 2000, 3000), command('c', 3000), command('d', 4000), command('e', 6000));
    const rows = rows_of(commands);
    expect([...rows.of.values()]).toEqual([0, 1, 1, 2, 0]);
    expect(rows.count).toBe(3);
  });
});

describe('a span', () => {
  test('is placed by its start and end', () => {
    const past = ring(span('status', 'follow', 'READY', 10_000, 30_000), span('status', 'follow', 'ERROR', 50_000, 60_000));
    const present = [span('status', 'follow', 'READY', 60_000, 99_500)];
    expect(boxes(lay_out(sources({ past, present }), range, wide), 'span')).toEqual([
      [100, 200],
      [200, 600],
    ]);
  });

  test('continues until now, unless it was not observed for long', () => {
    expect(end_of(span('status', 'a', 'READY', 0, 99_000), true, 100_000)).toBe(100_000);
    expect(end_of(span('status', 'a', 'READY', 0, 50_000), true, 100_000)).toBe(50_000);
    expect(end_of(span('status', 'a', 'READY', 0, 99_000), false, 100_000)).toBe(99_000);
  });

  test("a command is in its component's lane and in that of commands, from its sending", () => {
    const layout = lay_out(sources({ commands: ring(command('navigation', 50_000, 52_000, 70_000), command('follow', 0, 0, 30_000)) }), range, wide);
    expect(layout.placed.map(({ lane }) => lanes_of(layout)[lane])).toEqual(['navigation', 'commands']);
    expect(boxes(layout, 'command')).toEqual([
      [100, 300],
      [100, 300],
    ]);
  });
});

describe('events', () => {
  test('that are dense are combined in fixed time bins', () => {
    const marks = [1000, 1900, 2000, 2500, 9000].map((at): Mark => ({ kind: 'event', entry: event(at) }));
    expect(clusters(marks, 1000).map((one) => one.marks.length)).toEqual([2, 2, 1]);
    const dense = ring(...Array.from({ length: 5000 }, (_, i) => event(40_000 + i * 12)));
    const layout = lay_out(sources({ events: dense }), range, wide);
    expect(layout.placed.length).toBeLessThan(150);
    const counted = layout.placed.filter(({ lane }) => lanes_of(layout)[lane] === 'events').reduce((sum, { thing }) => sum + (thing.kind === 'marks' ? thing.marks.length : 0), 0);
    expect(counted).toBe(5000);
  });

  test('have numbers that do not overlap each other or those of errors', () => {
    const events = ring(...[50_900, 50_990, 51_010, 51_100].map((at) => event(at)));
    const gaps = ring(...[50_950, 50_960].map((at) => ({ number: next++, at, reason: 'LOST', count: 1 }) as unknown as GapEntry));
    const layout = lay_out(sources({ events, gaps }), range, wide);
    const shown = layout.placed.filter(({ lane }) => lanes_of(layout)[lane] === 'events').map(({ box }) => box);
    expect(shown).toHaveLength(3);
    const apart = (a: (typeof shown)[0], b: (typeof shown)[0]) => a.y + a.height <= b.y || b.y + b.height <= a.y || Math.abs(a.x + a.width / 2 - b.x - b.width / 2) > 30;
    for (const [i, one] of shown.entries()) for (const other of shown.slice(i + 1)) expect(apart(one, other)).toBe(true);
  });

  test('of a switch are in the lane of the logical component, with a warning', () => {
    const switched: Switched = { name: 'switched', sequence: 1, component_ref: { code: 'navigation' }, from: 'robot1.navigation', to: 'robot2.navigation', reason: 'it failed' };
    const layout = lay_out(sources({ switches: ring({ number: 0, at: 70_000, switched, document: 0 }) }), range, wide);
    expect(layout.placed.map(({ lane }) => lanes_of(layout)[lane])).toEqual(['navigation', 'events']);
    const { thing } = layout.placed[0]!;
    expect(thing.kind === 'marks' && marks_tone(thing.marks)).toBe('warning');
    expect(sentence(describe_thing(thing, 100_000))).toMatch(/^Switched, robot1.navigation → robot2.navigation, navigation, Time .*, Reason it failed$/);
  });

  test("of the console's own subscriptions are shown on request", () => {
    const some = sources({ events: ring(event(60_000), event(80_000)), own_events: ring(event(70_000)) });
    const count = (with_own: boolean) => lay_out(some, range, { ...wide, with_own }).placed.length;
    expect([count(false), count(true)]).toEqual([4, 6]);
  });

  test('are found by time', () => {
    const rows = ring(...[10, 20, 20, 30].map((at) => ({ at })));
    expect([5, 10, 15, 20, 25, 31].map((at) => first_since(rows, (one) => one.at, at))).toEqual([0, 0, 1, 1, 3, 4]);
  });
});

describe('a failure', () => {
  const failed = command('navigation', 50_000, 50_000, 50_020, 'ERROR');
  const answer = { number: 7, at: 70_000, direction: 'in', kind: 'answer', name: 'execute_response', text: '<a><reason>too loud</reason></a>', return_code: 'BAD_PARAMETER', is_own: false } as const;
  const refused = { ...answer, request: { ...answer, name: 'execute', component: 'speech_synthesis' } };
  const it = sources({ commands: ring(failed, command('follow', 60_000, 60_000, 61_000)), refused: ring(refused) });
  const layout = lay_out(it, range, wide);
  const marks = layout.placed.filter((one) => one.thing.kind === 'marks' && layout.lanes[one.lane]!.kind === 'events');

  test('is among events and errors: failed commands and refusals', () => {
    expect(marks.map(({ thing }) => thing.kind === 'marks' && thing.marks.map((one) => one.kind))).toEqual([['failed'], ['refused']]);
    expect(sentence(describe_thing(marks[1]!.thing, 100_000))).toMatch(/^Refused, execute, speech_synthesis, BAD_PARAMETER, Time .* Reason too loud$/);
    expect(opened_by(marks[0]!.thing)).toEqual({ kind: 'command', entry: failed });
    expect(opened_by(marks[1]!.thing)).toBe(marks[1]!.thing);
  });

  test('is hit within 12 px, however short', () => {
    const y = layout.lanes.find((one) => one.ref === 'navigation')!.y + 23;
    expect([94, 95.6, 101.5, 107.4, 108.5].map((x) => thing_at(layout, x, y)?.thing.kind)).toEqual([undefined, 'command', 'command', 'command', undefined]);
  });
});

describe('pointer and keys', () => {
  const layout = () =>
    lay_out(
      sources({
        commands: ring(command('navigation', 50_000, 52_000, 70_000)),
        events: ring(event(60_000), event(80_000)),
        present: [span('status', 'navigation', 'READY', 40_000, 100_000)],
      }),
      range,
      wide,
    );
  const name = (one: Placed | undefined) => one && `${lanes_of(layout())[one.lane]} ${one.thing.kind}`;

  test('the topmost thing is hit, a small one also from beside', () => {
    const it = layout();
    const lane = it.lanes.findIndex((one) => one.ref === 'navigation');
    const { y } = it.lanes[lane]!;
    expect(name(thing_at(it, 150, y + 23))).toBe('navigation command');
    expect(name(thing_at(it, 150, y + 8))).toBe('navigation span');
    expect(thing_at(it, 590, y + 23)).toBeUndefined();
    const events = it.lanes.find((one) => one.kind === 'events')!;
    expect(name(thing_at(it, 204, events.y + 12))).toBe('events marks');
  });

  test('arrows go along a lane and to the next lane with things', () => {
    const it = layout();
    let at = next_thing(it, undefined, 'ArrowDown');
    expect(name(at)).toBe('commands command');
    at = next_thing(it, at, 'ArrowDown');
    expect(name(at)).toBe('events marks');
    expect(at!.box.x).toBeLessThan(210);
    at = next_thing(it, at, 'ArrowRight');
    expect(at!.box.x).toBeGreaterThan(380);
    expect(next_thing(it, at, 'ArrowRight')).toBe(at);
    expect(name(next_thing(it, at, 'ArrowDown'))).toBe('navigation span');
    expect(name(next_thing(it, next_thing(it, at, 'ArrowUp'), 'ArrowUp'))).toBe('commands command');
  });
});

describe('the shown range', () => {
  test('grows and shrinks around a time, and to the left if live', () => {
    expect(zoomed({ span: 1000, end: 5000 }, 0.5, 4500)).toEqual({ span: 500, end: 4750 });
    expect(zoomed({ span: 1000 }, 2, 4500)).toEqual({ span: 2000 });
  });
  test('stays between the oldest known time and now', () => {
    expect(within({ span: 10_000, end: 200_000 }, 0, 100_000)).toEqual({ span: 10_000, end: 100_000 });
    expect(within({ span: 10_000, end: -50_000 }, 0, 100_000)).toEqual({ span: 10_000, end: 2500 });
    expect(within({ span: 1e12 }, 0, 3_600_000).span).toBeCloseTo(3_960_000);
    expect(within({ span: 1 }, 0, 1000).span).toBe(50);
  });
});

describe('a view', () => {
  let world: World;
  let console: Console;
  let view: TimeView;
  beforeEach(async () => {
    world = new World();
    world.answers.set('get_profile', () => profile_xml({ navigation: { type: 'Navigation' } }));
    world.pages.set('/rois/map', { status: 404, text: '' });
    console = await world.console();
    view = new TimeView(console);
  });
  const happens = async () => {
    await world.notifies('receive_event', '<event_id>e</event_id><event_type>x</event_type><subscribe_id>s</subscribe_id><expire>2026-11-20T13:00:00Z</expire><component_ref rois:code="navigation"/>');
    await settled();
  };

  test('follows the time until it is stopped, and stays then', async () => {
    await happens();
    const before = view.range(view.sources.at);
    await world.passes(5000);
    expect(view.range(view.sources.at).to).toBe(before.to + 5000);
    view.pause();
    const stopped = view.range(view.sources.at);
    for (let i = 0; i < 3; ++i) await happens();
    await world.passes(60_000);
    expect(view.range(view.sources.at)).toEqual(stopped);
    expect(view.sources.events.size).toBe(1);
    expect(console.events.events.size).toBe(4);
    view.go_live();
    expect(view.sources.events.size).toBe(4);
  });

  test('stays when stopped, even if the rings forget', async () => {
    await happens();
    const held = stopped_sources(console);
    console.events.events.clear();
    expect([...held.events]).toHaveLength(1);
    expect(oldest_of(held)).toBeLessThanOrEqual(held.at);
  });

  test('returns from a selected range', async () => {
    await happens();
    await world.passes(60_000);
    const now = view.sources.at;
    view.show(now - 20_000, now - 10_000);
    expect(view.stretch.value).toEqual({ span: 10_000, end: now - 10_000 });
    view.undo();
    expect(view.is_live).toBe(true);
    expect(view.can_undo).toBe(false);
  });

  test('the whole range keeps growing', async () => {
    await happens();
    const { from } = view.range(view.sources.at);
    view.show_all();
    const first = oldest_of(view.sources);
    await world.passes(1_200_000);
    const all = view.range(view.sources.at);
    expect(all.from).toBeLessThanOrEqual(first);
    expect(all.to).toBe(view.sources.at);
    expect(all.from).not.toBe(from);
    view.pause();
    expect(view.range(view.sources.at)).toEqual(all);
  });

  test('is held under the pointer when live, and stops there', async () => {
    await happens();
    const before = view.range(view.sources.at);
    view.held.value = before.to;
    await world.passes(5000);
    expect(view.range(view.sources.at)).toEqual(before);
    expect(view.is_live).toBe(true);
    view.pause();
    expect(view.range(view.sources.at)).toEqual(before);
    view.go_live();
    expect(view.range(view.sources.at).to).toBe(view.sources.at);
  });

  test('stops when moved', async () => {
    await world.passes(600_000);
    view.move(-30_000);
    expect(view.is_live).toBe(false);
    view.move(1e9);
    expect(view.range(0).to).toBe(view.sources.at);
  });
});

test('things are described in a sentence', () => {
  const described = describe_thing({ kind: 'command', entry: command('navigation', 50_000, 50_400, 52_400, 'ERROR') }, 60_000);
  expect(sentence(described)).toMatch(/^Command, start, navigation, ERROR, Sent [\d:.]+, Began [\d:.]+, Ended [\d:.]+, Waited 400 ms, Ran 2\.0 s$/);
  const many: Mark[] = [event(1000), event(2000), event(3000, 'person_detection', 'other')].map((entry) => ({ kind: 'event', entry }));
  expect(sentence(describe_thing({ kind: 'marks', marks: many }, 5000))).toMatch(/^3 events and errors, person_detection, Time .*, person_detected × 2, other × 1$/);
  expect(describe_thing({ kind: 'span', span: span('holder', 'follow', '4', 0, 1000) }, 60_000)).toMatchObject({ kind: 'Bound', title: 'by session 4', component: 'follow' });
});

describe('axes', () => {
  test('have round times', () => {
    const from = new Date(2026, 0, 5, 14, 3, 21, 300).getTime();
    expect(time_marks(from, from + 20_000, 4000).map((one) => one.text)).toEqual(['14:03:25', '14:03:30', '14:03:35', '14:03:40']);
    expect(time_marks(from, from + 7_200_000, 1_800_000).map((one) => one.text)).toEqual(['14:30', '15:00', '15:30', '16:00']);
    expect(time_marks(from, from + 300, 100).map((one) => one.text)).toEqual(['03:21.3', '03:21.4', '03:21.5', '03:21.6']);
  });
  test('have round values', () => {
    expect([0, 1, 7, 42, 0.3, 1234].map((most) => value_marks(most, 3))).toEqual([
      [0, 0.5],
      [0, 0.5, 1],
      [0, 5, 10],
      [0, 20, 40, 60],
      [0, 0.1, 0.2, 0.3],
      [0, 500, 1000, 1500],
    ]);
  });
});
