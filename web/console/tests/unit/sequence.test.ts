// Sequences: the tree of steps, units, validation, and progress of a run.
import { type CommandUnit, concurrently, command, delay, in_parallel, parse_xml, sequence_xml, sequentially, type XmlElement } from 'rois-client';
import { describe, expect, test } from 'vitest';

import { problems_in_sequence, type Profiles } from '../../src/sequence/checking';
import { draft_of, draft_text } from '../../src/sequence/draft';
import { move } from '../../src/sequence/keys';
import { drop_sequence, keep_sequence, kept_sequences } from '../../src/sequence/library';
import {
  copy_of, type Direction, type Lane, neighbour, new_command, new_lane, new_parallel, new_wait, type Step, steps_of, with_branch, with_inserted, with_moved, without, without_branch,
} from '../../src/sequence/model';
import { run_view } from '../../src/sequence/running';
import { SequenceStore } from '../../src/sequence/store';
import { lane_of, units_of_lane } from '../../src/sequence/units';
import type { Console } from '../../src/state/console';
import { views_of } from '../../src/state/engine/profile_state';
import type { CommandEntry, CommandState } from '../../src/state/session/commands_state';
import { units_of } from '../../src/state/session/sequences';
import { profile_xml, settled, World } from './world';

const run = (component: string, command_type = 'start') => new_command({ component, command_type });
const text_of = (step: Step): string => {
  if (step.kind === 'wait') return step.time;
  return step.kind === 'command' ? step.component : `(${step.branches.map(text_of_lane).join('|')})`;
};
const text_of_lane = (lane: Lane): string => lane.steps.map(text_of).join(' ');

// Annex B.1: A, B, then (C then D) parallel to E, then F.
function annex_b() {
  const [a, b, c, d, e, f] = ['A', 'B', 'C', 'D', 'E', 'F'].map((one) => run(one)) as [Step, Step, Step, Step, Step, Step];
  const both = new_parallel([new_lane([c, d]), new_lane([e])]);
  return { a, b, c, d, e, f, both, root: new_lane([a, b, both, f]) };
}

describe('the tree', () => {
  test('steps are added and removed without changing the old tree', () => {
    const { root, c, both, e } = annex_b();
    expect(text_of_lane(with_inserted(root, { lane: both.branches[1]!.id, index: 1 }, new_wait('5')))).toBe('A B (C D|E 5) F');
    expect(text_of_lane(without(root, c.id))).toBe('A B (D|E) F');
    expect(text_of_lane(without(root, both.id))).toBe('A B F');
    expect(text_of_lane(with_branch(root, both.id))).toBe('A B (C D|E|) F');
    expect(text_of_lane(without_branch(root, both.branches[1]!.id))).toBe('A B C D F');
    expect(text_of_lane(without_branch(with_branch(root, both.id), both.branches[0]!.id))).toBe('A B (E|) F');
    expect(text_of_lane(without(root, e.id))).toBe('A B (C D|) F');
    expect(text_of_lane(root)).toBe('A B (C D|E) F');
    const copy = copy_of(both);
    expect(text_of(copy)).toBe('(C D|E)');
    expect(steps_of(new_lane([copy])).some((one) => steps_of(root).some(({ id }) => id === one.id))).toBe(false);
  });

  test('steps are dropped anywhere, except into themselves', () => {
    const { root, a, both, f } = annex_b();
    const [upper, lower] = both.branches as [Lane, Lane];
    expect(text_of_lane(with_moved(root, a.id, { lane: root.id, index: 2 }))).toBe('B A (C D|E) F');
    expect(text_of_lane(with_moved(root, a.id, { lane: lower.id, index: 0 }))).toBe('B (C D|A E) F');
    expect(text_of_lane(with_moved(root, f.id, { lane: upper.id, index: 1 }))).toBe('A B (C F D|E)');
    expect(with_moved(root, a.id, { lane: root.id, index: 1 })).toBe(root);
    expect(with_moved(root, both.id, { lane: upper.id, index: 0 })).toBe(root);
  });

  test.each<['a' | 'b' | 'c' | 'd' | 'e' | 'f', Direction, string]>([
    ['a', 'later', 'B A (C D|E) F'],
    ['a', 'earlier', 'A B (C D|E) F'],
    ['d', 'earlier', 'A B (D C|E) F'],
    ['c', 'earlier', 'A B C (D|E) F'],
    ['d', 'later', 'A B (C|E) D F'],
    ['d', 'down', 'A B (C|E D) F'],
    ['e', 'up', 'A B (E C D|) F'],
    ['b', 'down', 'A (B C D|E) F'],
    ['f', 'up', 'A B (C D|E F)'],
    ['a', 'up', 'A B (C D|E) F'],
  ])('%s is moved %s by a key', (which, direction, expected) => {
    const all = annex_b();
    const store = { root: { value: all.root }, change: (to: Lane) => (store.root.value = to) };
    move(store as unknown as SequenceStore, all[which].id, direction);
    expect(text_of_lane(store.root.value)).toBe(expected);
  });

  test('arrow keys select neighbours', () => {
    const { root, a, b, c, d, e, f, both } = annex_b();
    const way = (from: Step, ...keys: Direction[]) => keys.map((key) => (from = steps_of(root).find(({ id }) => id === neighbour(root, from.id, key))!)).map((one) => one.id);
    expect(way(a, 'later', 'later', 'later', 'later', 'later')).toEqual([b, both, c, d, f].map(({ id }) => id));
    expect(way(d, 'down', 'up', 'earlier', 'earlier')).toEqual([e, c, both, b].map(({ id }) => id));
    expect(neighbour(root, a.id, 'earlier')).toBeUndefined();
    expect(neighbour(root, 0, 'later')).toBe(a.id);
  });
});

describe('units', () => {
  const units = (root: Lane) => units_of_lane(root, () => []);
  const start = (ref: string, delay_time?: number) => command(ref, 'start', {}, delay_time === undefined ? {} : { delay_time });

  test('branches of commands are written in the published form', () => {
    expect(units(annex_b().root)).toEqual([start('A'), start('B'), concurrently([start('C'), start('D')], start('E')), start('F')]);
  });

  test('a wait in a branch becomes the delay of the next command', () => {
    const root = new_lane([new_parallel([new_lane([new_wait('200'), run('A')]), new_lane([run('B')])], '50')]);
    expect(units(root)).toEqual([{ ...concurrently([start('A', 200)], start('B')), delay_time: 50 }]);
  });

  test('deeper nesting is written as in RoIS 1.0', () => {
    const root = new_lane([new_parallel([new_lane([run('A'), new_parallel([new_lane([run('B')]), new_lane([run('C')])])]), new_lane([run('D'), new_wait('5')]), new_lane()])]);
    expect(units(root)).toEqual([in_parallel(sequentially(start('A'), concurrently(start('B'), start('C'))), sequentially(start('D'), delay(5)))]);
  });

  test('a parsed sequence is written again', () => {
    const given: CommandUnit[] = [
      start('A', 7), delay(200), concurrently([start('B'), start('C')], start('D')),
      { ...in_parallel(sequentially(start('E'), in_parallel(start('F'), sequentially(start('G'), delay(1)))), start('H')), delay_time: 3 },
    ];
    const read = lane_of(units_of(parse_xml(sequence_xml(given).replace('<rois:CommandUnitSequence', '<rois:CommandUnitSequence xmlns:rois="http://www.omg.org/spec/RoIS/20240801" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"'))), () => true);
    expect(text_of_lane(read)).toBe('A 200 (B C|D) (E (F|G 1)|H)');
    expect(units(read)).toEqual(given);
  });

  test('a nested sequential unit is flattened', () => {
    expect(text_of_lane(lane_of([sequentially(start('A'), { ...sequentially(start('B')), delay_time: 9 })], () => true))).toBe('A 9 B');
  });
});

const parameter = '<rois:ParameterProfile rois:name="speech_text" rois:description="What. Mandatory."><rois:data_type_ref rois:code="string"/></rois:ParameterProfile><rois:ParameterProfile rois:name="volume"><rois:data_type_ref rois:code="int"/></rois:ParameterProfile>';
const profiles_xml = profile_xml({ speech: { type: 'SpeechSynthesis', parameters: parameter }, detection: { type: 'PersonDetection' }, navigation: { type: 'Navigation' } });

describe('checks', () => {
  const components = views_of({ engine: { id: '', identifier: '', name: '', sub_engines: [], parameters: [], components: [] }, components: [{ ref: 'speech', type: 'urn:s', engine: 'e' }], component_profiles: [{
    id: 'p', identifier: 'urn:s', name: 's', description: '', sub_profiles: ['urn:x-rois:def:component:OMG::RoISCommon'], messages: [],
    parameters: [{ name: 'speech_text', data_type_ref: { code: 'string' }, description: 'What. Mandatory.' }, { name: 'volume', data_type_ref: { code: 'int' } }],
  }] });
  const profiles: Profiles = { component: (ref) => components.find((one) => one.ref === ref), has_value: () => false };
  const found = (...steps: Step[]) => problems_in_sequence(new_lane(steps), profiles).map(({ what, fields }) => (fields ? `${what} ${Object.keys(fields).join()}` : what));
  const say = (texts: Record<string, string>, command_type = 'start') =>
    new_command({ component: 'speech', command_type, inputs: Object.fromEntries(Object.entries(texts).map(([name, text]) => [name, { texts: [text] }])) });

  test('missing and wrong values are reported', () => {
    expect(found()).toEqual(['nothing']);
    expect(found(new_wait('1'))).toEqual([]);
    expect(found(new_wait('-1'), new_command(), run('nobody'), run('speech', ''), run('speech', 'sing'))).toEqual(['no_time', 'no_component', 'unknown_component', 'no_command', 'unknown_command']);
    expect(found(say({}))).toEqual(['arguments speech_text']);
    expect(found(say({ speech_text: 'a', volume: 'loud' }))).toEqual(['arguments volume']);
    expect(found(say({ speech_text: 'a' }), new_parallel())).toEqual(['no_branches']);
    expect(found({ ...say({ speech_text: 'a' }), unknown: [{ name: 'x', data_type_ref: { code: 'int' }, values: ['1'] }] })).toEqual(['unknown_arguments']);
    expect(found({ ...say({ speech_text: 'a' }), delay: 'soon' })).toEqual(['no_time']);
  });

  test('values set by an earlier step may be omitted', () => {
    expect(found(say({ speech_text: 'a' }, 'set_parameter'), say({}))).toEqual([]);
    expect(found(say({}), say({ speech_text: 'a' }, 'set_parameter'))).toEqual(['arguments speech_text']);
  });
});

describe('a run', () => {
  const entry = (state: CommandState, times: Partial<CommandEntry> = {}) => ({ state, sent_at: 0, ...times }) as CommandEntry;
  const states = (root: Lane, entries: [Step, CommandEntry][], now: number) => {
    const view = run_view(root, new Map(entries.map(([step, one]) => [step.id, one])), 0, now);
    return steps_of(root).map((one) => view.get(one.id)?.state ?? '-').join(' ');
  };

  test('waits and branches are inferred from the commands', () => {
    const wait = new_wait('500');
    const { root: rest, a, b, c, d, e, f } = annex_b();
    const root = { ...rest, steps: [a, wait, b, ...rest.steps.slice(2)] };
    const waiting = [b, c, d, e, f].map((one): [Step, CommandEntry] => [one, entry('waiting')]);
    expect(states(root, [[a, entry('running')], ...waiting], 100)).toBe('running waiting waiting waiting waiting waiting waiting waiting');
    const done = entry('OK', { ended_at: 200 });
    expect(states(root, [[a, done], ...waiting], 300)).toBe('OK running waiting waiting waiting waiting waiting waiting');
    expect(states(root, [[a, done], ...waiting], 700)).toBe('OK OK waiting waiting waiting waiting waiting waiting');
    expect(states(root, [[a, done], [b, entry('OK', { ended_at: 800 })], [c, done], [d, entry('running')], [e, entry('ERROR', { ended_at: 900 })], [f, entry('waiting')]], 1000)).toBe('OK OK OK running OK running ERROR waiting');
    expect(states(root, [[a, done], [b, done], [c, done], [d, done], [e, entry('ERROR', { ended_at: 900 })], [f, entry('ABORT', { ended_at: 900 })]], 1000)).toBe('OK OK OK ERROR OK OK ERROR ABORT');
    expect(states(root, [[a, entry('ERROR', { ended_at: 1 })], ...[b, c, d, e, f].map((one): [Step, CommandEntry] => [one, entry('ABORT', { ended_at: 1 })])], 1000)).toBe('ERROR ABORT ABORT ABORT ABORT ABORT ABORT ABORT');
  });

  test('steps added later are not shown', () => {
    const [a, b] = [run('A'), run('B')];
    expect(states(new_lane([a, b]), [[a, entry('OK', { ended_at: 1 })]], 5)).toBe('OK -');
  });

  test('time counts from the end of the step before if the start was not reported', () => {
    const [a, b] = [run('A'), run('B')];
    const view = run_view(new_lane([a, b]), new Map([[a.id, entry('OK', { ended_at: 1000 })], [b.id, entry('ERROR', { ended_at: 1010 })]]), 100, 2000);
    expect([view.get(a.id)?.took, view.get(b.id)?.took]).toEqual([900, 10]);
  });
});

test('sequences are stored by name, and invalid data is ignored', () => {
  const world = new World();
  keep_sequence(world, 'b', '<b/>');
  expect([...keep_sequence(world, 'a', '<a/>')]).toEqual([['a', '<a/>'], ['b', '<b/>']]);
  expect([...drop_sequence(world, 'b').keys()]).toEqual(['a']);
  for (const text of ['', '[', 'null', '{"a":1}']) {
    world.remember('sequences', text);
    expect(kept_sequences(world).size).toBe(0);
  }
  for (const text of [undefined, '', 'null', '{}', '{"steps":[{}]}', '{"steps":[null]}']) expect(draft_of(text)).toBeUndefined();
  expect(text_of_lane(draft_of(draft_text(annex_b().root))!)).toBe('A B (C D|E) F');
});

describe('the store', () => {
  let said = '';
  const echo = (request: XmlElement) => {
    if (said !== '') return said;
    const text = (element: XmlElement): string => {
      const attribute = (name: string) => element.attributes.find((one) => one.name === name)?.value ?? '';
      if (element.name === 'component_ref') return `<rois:component_ref rois:code="${attribute('code')}"/>`;
      const about = element.name === 'command_unit_list' || element.name === 'command_list' ? ` xsi:type="${attribute('type')}" rois:command_type="${attribute('command_type')}" rois:command_id="${attribute('command_id')}"` : '';
      return element.name === 'arguments' ? '' : `<rois:${element.name}${about}>${element.children.map(text).join('')}</rois:${element.name}>`;
    };
    return text(request.child('CommandUnitSequence')!);
  };
  const connected = async (): Promise<{ world: World; console: Console; store: SequenceStore }> => {
    const world = new World();
    said = '';
    world.answers.set('get_profile', () => profiles_xml);
    world.answers.set('execute', echo);
    world.answers.set('get_command_result', () => '<results><result rois:name="status"><rois:data_type_ref rois:code="string"/><rois:value>RUNNING</rois:value></result></results>');
    world.pages.set('/rois/map', { status: 404, text: '' });
    const console = await world.console();
    return { world, console, store: new SequenceStore(console) };
  };
  const both = () => new_lane([new_parallel([new_lane([run('navigation')]), new_lane([new_command({ component: 'speech', command_type: 'start', inputs: { speech_text: { texts: ['Hello & welcome'] } } })])])]);
  const ids = (world: World) => world.requests.filter((one) => one.name === 'execute').map((one) => [...JSON.stringify(one).matchAll(/"command_id","namespace":"[^"]*","value":"([^"]*)"/g)].map(([, id]) => id!));

  test('runs the drawn sequence, shows it, and releases its components', async () => {
    const { world, console, store } = await connected();
    store.change(both());
    expect(store.problems.value).toEqual([]);
    expect(store.request).toContain('<rois:value>Hello &amp; welcome</rois:value>');
    await store.execute();
    await settled();
    expect(console.bindings.mine.value).toEqual(new Set(['navigation', 'speech']));
    expect(store.is_running).toBe(true);
    expect([...store.run.value!.entries.values()].map((one) => `${one.component} ${one.state}`)).toEqual(['navigation running', 'speech running']);
    const [one, two] = ids(world)[0]!;
    await world.notifies('completed', `<command_id>${one}</command_id><status>OK</status>`);
    await world.notifies('completed', `<command_id>${two}</command_id><status>OK</status>`);
    await settled();
    expect(store.is_running).toBe(false);
    expect(console.bindings.mine.value.size).toBe(0);
  });

  test('keeps components bound that work on after start', async () => {
    const { world, console, store } = await connected();
    store.change(new_lane([run('detection'), run('navigation')]));
    expect(store.going_on).toEqual(['detection']);
    await store.execute();
    for (const id of ids(world)[0]!) await world.notifies('completed', `<command_id>${id}</command_id><status>OK</status>`);
    await settled();
    expect(console.bindings.mine.value).toEqual(new Set(['detection', 'navigation']));
  });

  test('shows a refusal', async () => {
    const { store } = await connected();
    store.change(both());
    said = 'BAD_PARAMETER';
    await expect(store.execute()).rejects.toThrow('BAD_PARAMETER');
    expect(store.run.value).toMatchObject({ entries: new Map() });
    expect(store.run.value?.refused_step).toBeUndefined(); // it did not name a step
  });

  test('stops running commands, and releases components of delayed ones', async () => {
    const { world, console, store } = await connected();
    await console.bindings.bind('navigation');
    const status = (text: string) => `<results><result rois:name="status"><rois:data_type_ref rois:code="string"/><rois:value>${text}</rois:value></result></results>`;
    world.answers.set('get_command_result', (request) => status(request.text_of('command_id') === ids(world)[0]?.[1] ? 'WAITING' : 'RUNNING'));
    store.change(both());
    await store.execute();
    const [first, second] = ids(world)[0]!;
    const stopped = store.stop();
    await settled();
    await settled();
    const stops = ids(world).slice(1).flat();
    expect(stops.length).toBe(2);
    await world.notifies('completed', `<command_id>${first}</command_id><status>ABORT</status>`);
    for (const id of stops) await world.notifies('completed', `<command_id>${id}</command_id><status>OK</status>`);
    await stopped;
    // Its delayed command is aborted at its turn. Until then it must not be bound again.
    expect(world.requests.filter((one) => one.name === 'release').map((one) => one.child('component_ref')?.attributes[0]?.value)).toEqual(['speech']);
    expect(console.bindings.mine.value).toEqual(new Set(['navigation']));
    expect([store.is_running, store.still_queued]).toEqual([false, ['speech']]);
    await world.notifies('completed', `<command_id>${second}</command_id><status>ABORT</status>`);
    expect(store.still_queued).toEqual([]);
  });

  test('undoes, stores, exports and imports', async () => {
    const { store } = await connected();
    store.change(both());
    store.rename('Greeting');
    store.keep();
    const text = store.kept.value.get('Greeting')!;
    expect(text).toMatch(/^<\?xml version="1.0" encoding="UTF-8"\?>\n<rois:CommandUnitSequence xmlns:rois=/);
    expect(text_of_lane(store.read(text))).toBe('(navigation|speech)');
    expect(store.read(text).steps[0]).toMatchObject({ branches: [{}, { steps: [{ inputs: { speech_text: { texts: ['Hello & welcome'] } }, unknown: [] }] }] });
    expect(store.read(store.request).steps.length).toBe(1);
    expect(() => store.read('<a/>')).toThrow('no CommandUnitSequence');
    store.change(store.read(text.replaceAll('"speech"', '"nobody"')));
    expect(store.request).toContain('Hello &amp; welcome'); // arguments of unknown components stay
    store.undo();
    store.change(new_lane());
    store.undo();
    expect(text_of_lane(store.root.value)).toBe('(navigation|speech)');
    const unwritable = new_command({ component: 'speech', command_type: 'start', inputs: { speech_text: { texts: ['\u0001'] } } });
    store.change(new_lane([unwritable]));
    expect([store.request, store.document]).toEqual(['', '']);
    expect(store.problems.value).toMatchObject([{ what: 'arguments' }]);
  });
});
