// Conditions: references, writing and reading, validation, and matching components.
import { describe, expect, test } from 'vitest';

import { is_complete, problems_of } from '../../src/conditions/checking';
import { component_part, waits_for_results } from '../../src/conditions/matches';
import {
  type Draft, draft_of, draft_text, new_area, new_draft, new_group, new_predicate, new_sort_key, new_written, type Node, type Predicate, with_added, with_changed, with_wrapped, without,
} from '../../src/conditions/model';
import { about } from '../../src/conditions/predicate_view';
import { draft_read } from '../../src/conditions/reading';
import { ConditionStore } from '../../src/conditions/store';
import { operators_for, references_of, resolved } from '../../src/conditions/vocabulary';
import { condition_of, request_of } from '../../src/conditions/writing';
import type { Console } from '../../src/state/console';
import { profile_xml, settled, World } from './world';

const result = (name: string, type: string, more = '') => `<rois:Results rois:name="${name}" ${more}><rois:data_type_ref rois:code="${type}"/></rois:Results>`;
const localized = `<rois:MessageProfile xsi:type="rois:EventMessageProfileType" rois:name="person_localized">${result('timestamp', 'DateTime')}${result('person_ref', 'RoISIdentifier[]')}${result('position_data', 'string[]')}</rois:MessageProfile>`;
const detected = `<rois:MessageProfile xsi:type="rois:EventMessageProfileType" rois:name="person_detected">${result('number', 'int')}</rois:MessageProfile>`;
const volume = '<rois:ParameterProfile rois:name="volume" rois:description="How loud, in percent."><rois:data_type_ref rois:code="int"/></rois:ParameterProfile>';

async function connected(): Promise<{ world: World; console: Console; store: ConditionStore }> {
  const world = new World();
  world.answers.set('get_profile', () =>
    profile_xml({ person_localization: { type: 'PersonLocalization', messages: localized }, person_detection: { type: 'PersonDetection', messages: detected }, speech_synthesis: { type: 'SpeechSynthesis', parameters: volume } }),
  );
  world.answers.set('query', () => '<component_ref rois:code="x"/><results/>');
  world.pages.set('/rois/map', { status: 200, text: '<floor_map xmlns="urn:x-rois:map:1" name="Hall" crs="c"><bounds x="0" y="0" width="1" depth="1"/><place name="desk" x="1" y="1" heading="0" width="1" depth="1"/></floor_map>' });
  const console = await world.console();
  await settled();
  return { world, console, store: new ConditionStore(console) };
}

const of = (draft: Partial<Draft>, ...nodes: Node[]): Draft => ({ ...new_draft(), root: new_group(nodes), ...draft });
const names = (list: readonly { path: string }[]) => list.map((one) => one.path);
// Without ids, which are new each time.
const plain = (value: unknown): unknown => JSON.parse(JSON.stringify(value, (key, one: unknown) => (key === 'id' ? undefined : one)));

describe('the vocabulary', () => {
  test('has properties, parameters, and the results of the event or query', async () => {
    const { store } = await connected();
    const known = store.known.value;
    expect(names(references_of(known, of({})))).toEqual(['component_ref', 'component_type', 'status', 'bound', 'location', 'engine', 'RobotId', 'Property/volume']);
    const events = references_of(known, of({ purpose: 'subscribe', event_type: 'person_localized' }));
    expect(names(events).slice(0, 5)).toEqual(['timestamp', 'person_ref', 'position_data', 'located', 'component_ref']);
    expect(events.slice(0, 3).map(({ type, is_list }) => [type, is_list])).toEqual([['time', false], ['text', true], ['position', true]]);
    expect(resolved('rois:Property/rois:VOLUME', events)).toMatchObject({ type: 'number', unit: '%' });
    expect(resolved('volume', events)?.path).toBe('Property/volume');
    expect(resolved("located[@ref='p']/@crs", events)).toMatchObject({ type: 'text' });
    expect(resolved('nonsense', events)).toBeUndefined();
    expect(resolved('location', events)?.options).toEqual(['Hall', 'desk']);
    expect(resolved('component_type', events)?.options).toContain('urn:x-rois:def:component:OMG::PersonLocalization');
  });

  test('offers operators by type, and resets them for another reference', async () => {
    const { store } = await connected();
    const references = references_of(store.known.value, of({ purpose: 'subscribe', event_type: 'person_localized' }));
    expect(operators_for('bool')).not.toContain('LessThan');
    expect(about(new_predicate({ reference: 'status', value: 'READY', operator: 'Like' }), 'position_data', references)).toMatchObject({ operator: 'Within', value: '', area: { kind: 'box' } });
    expect(about(new_predicate({ reference: 'person_ref', matching: 'All' }), 'status', references)).toMatchObject({ matching: 'Any' });
  });
});

const area = { box: { ...new_area('box'), x: '7500', y: '8200', x2: '11500', y2: '10200' }, place: { ...new_area('place'), place: 'desk' }, point: { ...new_area('point'), x: '1', y: '-2.5', crs: 'c' } };
const predicates: [string, Partial<Predicate>][] = [
  ['<fes:PropertyIsEqualTo>', { reference: 'status', value: 'READY' }],
  ['<fes:PropertyIsNotEqualTo matchAction="All" matchCase="false">', { reference: 'person_ref', operator: 'NotEqualTo', value: 'a <b>', match_case: false, matching: 'All' }],
  ['<fes:PropertyIsLessThan>', { reference: 'number', operator: 'LessThan', value: '3' }],
  ['<fes:PropertyIsGreaterThanOrEqualTo>', { reference: 'number', operator: 'GreaterThanOrEqualTo', value: '1' }],
  ['<fes:LowerBoundary><fes:Literal>1</fes:Literal></fes:LowerBoundary>', { reference: 'number', operator: 'Between', value: '1', upper: '2' }],
  ['wildCard="*"', { reference: 'component_ref', operator: 'Like', value: 'person_*' }],
  ['<fes:PropertyIsNull>', { reference: 'Property/volume', operator: 'Null' }],
  ['<gml:lowerCorner>7500 8200</gml:lowerCorner><gml:upperCorner>11500 10200</gml:upperCorner>', { reference: 'position_data', operator: 'Within', area: area.box }],
  ['<fes:Within><fes:ValueReference>location</fes:ValueReference><fes:Literal>desk</fes:Literal></fes:Within>', { reference: 'location', operator: 'Within', area: area.place }],
  ['<gml:Point srsName="c"><gml:pos>1 -2.5</gml:pos></gml:Point><fes:Distance uom="mm">2000</fes:Distance>', { reference: 'location', operator: 'DWithin', area: area.point, distance: '2000' }],
  ['<fes:Beyond>', { reference: 'location', operator: 'Beyond', area: area.place, distance: '1' }],
  ['<fes:Disjoint>', { reference: 'location', operator: 'Disjoint', area: area.box }],
  ['<fes:After>', { reference: 'timestamp', operator: 'After', value: '2026-11-20T12:00:00.000Z' }],
  ['<gml:endPosition>2026-11-20T12:00:01.000Z</gml:endPosition>', { reference: 'timestamp', operator: 'During', value: '2026-11-20T12:00:00.000Z', upper: '2026-11-20T12:00:01.000Z' }],
];

describe('XML', () => {
  test.each(predicates)('%s is written and read back', async (expected, given) => {
    const { store } = await connected();
    const draft = of({ purpose: 'subscribe', event_type: 'person_localized' }, new_predicate(given));
    const references = references_of(store.known.value, draft);
    expect(problems_of(draft.root, references)).toEqual([]);
    const request = request_of(draft, condition_of(draft, references));
    expect(request).toContain(expected);
    expect(plain(draft_read(request))).toEqual(plain(draft));
  });

  test('groups, negation and order are written and read back', async () => {
    const { store } = await connected();
    const ready = () => new_predicate({ reference: 'status', value: 'READY' });
    const draft = of(
      { purpose: 'bind_any', order: [new_sort_key({ by: 'distance', reference: 'location', area: area.place }), new_sort_key({ reference: 'component_ref', order: 'DESC' })] },
      new_group([ready(), new_group([ready(), new_predicate({ reference: 'bound', value: 'true', is_not: true })], 'And', true)], 'Or'),
      ready(),
    );
    const references = references_of(store.known.value, draft);
    const request = request_of(draft, condition_of(draft, references));
    expect(request).toMatch(/^<bind_any [^>]*><condition><fes:Filter><fes:And><fes:Or>.*<fes:Not><fes:And>.*<fes:Not><fes:PropertyIsEqualTo>.*<\/fes:Filter><fes:SortBy>.*name="distance".*DESC/);
    expect(plain(draft_read(request))).toEqual(plain(draft));
    // Events are not sorted.
    expect(request_of({ ...draft, purpose: 'subscribe' }, condition_of({ ...draft, purpose: 'subscribe' }, references))).not.toContain('SortBy');
  });

  test('incomplete parts are omitted, and corners are sorted', async () => {
    const { store } = await connected();
    const draft = of({}, new_predicate(), new_predicate({ reference: 'location', operator: 'Within', area: { ...area.box, x: '11500', x2: '7500' } }), new_group());
    const condition = condition_of(draft, references_of(store.known.value, draft));
    expect(condition.predicate).toMatch(/^<fes:Within>.*7500 8200.*11500 10200/);
    expect(request_of(of({}), condition_of(of({}), []))).toMatch(/^<search [^>]*\/>$/);
  });

  test('fragments are read, and predicates without fields in the form stay XML', async () => {
    const { store } = await connected();
    const draft = draft_read(`<?xml version="1.0"?>
      <fes:Filter><fes:And><fes:BBOX><fes:ValueReference>position_data</fes:ValueReference><gml:Envelope><gml:pos>1 2</gml:pos><gml:pos>3 4</gml:pos></gml:Envelope></fes:BBOX>
      <fes:PropertyIsLessThan><fes:Function name="distance"><fes:ValueReference>location</fes:ValueReference><fes:Literal>desk</fes:Literal></fes:Function><fes:Literal>3000</fes:Literal></fes:PropertyIsLessThan>
      <fes:DWithin><fes:ValueReference>location</fes:ValueReference><fes:Literal>desk</fes:Literal><fes:Distance uom="m">1.5</fes:Distance></fes:DWithin></fes:And></fes:Filter>
      <fes:SortBy><fes:SortProperty><fes:ValueReference>name</fes:ValueReference></fes:SortProperty></fes:SortBy>`);
    expect(draft.root.members.map((one) => one.kind)).toEqual(['predicate', 'written', 'predicate']);
    expect(draft.root.members[0]).toMatchObject({ operator: 'Intersects', area: { kind: 'box', x: '1', y2: '4' } });
    expect(draft.root.members[2]).toMatchObject({ distance: '1500' });
    expect(draft.order).toMatchObject([{ reference: 'name', order: 'ASC' }]);
    const references = references_of(store.known.value, draft);
    expect(condition_of(draft, references).xml).toContain('<fes:Function name="distance"><fes:ValueReference>location</fes:ValueReference>');
    expect(draft_read('<search xmlns="urn:x-rois:psm:xml:message:1"/>')).toMatchObject({ purpose: 'search', root: { members: [] } });
    expect(() => draft_read('<a><b></a>')).toThrow();
    expect(() => draft_read('<unr:SearchCondition/>')).toThrow('SearchCondition');
  });
});

test('missing and wrong values are reported', async () => {
  const { store } = await connected();
  const draft = of({ purpose: 'subscribe', event_type: 'person_detected' });
  const references = references_of(store.known.value, draft);
  const found = (given: Partial<Predicate>) => problems_of(new_predicate(given), references).map(({ field, problem, is_missing }) => `${field} ${problem}${is_missing ? '' : '!'}`);
  expect(found({})).toEqual(['reference no_reference', 'value no_value']);
  expect(found({ reference: 'number', value: 'three' })).toEqual(['value no_number!']);
  expect(found({ reference: 'number', operator: 'Between', value: '3', upper: '1' })).toEqual(['upper reversed!']);
  expect(found({ reference: 'status', value: 'a\u0000' })).toEqual(['value unwritable!']);
  expect(found({ reference: 'location', operator: 'DWithin', area: new_area('point') })).toEqual(['area no_point', 'distance no_distance']);
  expect(found({ reference: 'x', operator: 'After', value: 'soon' })).toEqual(['value no_time']);
  expect(problems_of(new_written('<fes:A/><fes:B/>'), references)).toMatchObject([{ problem: 'no_xml' }]);
  expect(problems_of(new_written('<fes:PropertyIsNull><fes:ValueReference>x</fes:ValueReference></fes:PropertyIsNull>'), references)).toEqual([]);
  expect(is_complete(draft, references)).toBe(true);
  expect(is_complete({ ...draft, event_type: '' }, references)).toBe(false);
});

test('edits do not change the old tree', () => {
  const [a, b] = [new_predicate({ reference: 'a' }), new_predicate({ reference: 'b' })];
  const root = new_group([a, new_group([b], 'Or')]);
  const shape = (node: Node): unknown => (node.kind === 'group' ? node.members.map(shape) : node.kind === 'predicate' ? node.reference : 'xml');
  expect(shape(without(root, b.id))).toEqual(['a', []]);
  expect(shape(with_wrapped(root, a.id))).toEqual([['a'], ['b']]);
  expect(shape(with_added(root, root.id, new_predicate({ reference: 'c' })))).toEqual(['a', ['b'], 'c']);
  expect(shape(with_changed(root, b.id, (one) => ({ ...one, reference: 'd' }) as Node))).toEqual(['a', ['d']]);
  expect(shape(root)).toEqual(['a', ['b']]);
});

describe('the present matches', () => {
  test('for an event, only the part that is known before is searched', async () => {
    const { store } = await connected();
    const inside = () => new_predicate({ reference: 'position_data', operator: 'Within', area: area.place });
    const ready = (is_not = false) => new_predicate({ reference: 'status', value: 'READY', is_not });
    const part = (...nodes: Node[]) => {
      const draft = of({ purpose: 'subscribe', event_type: 'person_localized' }, ...nodes);
      return component_part(draft, references_of(store.known.value, draft)).predicate.replace(/<[^>]*>/g, (mark) => (/Not>|Or>|And>/.test(mark) ? mark.replace('fes:', '') : ''));
    };
    expect(part(inside())).toBe('');
    expect(part(inside(), ready())).toBe('statusREADY');
    expect(part(new_group([inside(), ready()], 'Or'), ready(true))).toBe('<Not>statusREADY</Not>');
    expect(part(new_group([inside(), ready()], 'Or', true))).toBe('<Not>statusREADY</Not>');
    expect(part(new_group([inside(), ready()], 'And', true))).toBe('');
    expect(part(new_group([new_group([inside(), ready()]), ready()], 'Or', true))).toBe('<Not>statusREADY</Not>');
    const draft = of({ purpose: 'subscribe', event_type: 'person_localized' }, inside());
    expect(waits_for_results(draft, references_of(store.known.value, draft))).toBe(true);
  });

  test('is searched after a delay, and polled while watched', async () => {
    const { world, console, store } = await connected();
    world.answers.set('search', () => '<component_ref_list><component_ref rois:code="person_localization"/><component_ref rois:code="speech_synthesis"/></component_ref_list>');
    const stop = store.matches.watch();
    const draft = of({}, new_predicate({ reference: 'bound', value: 'false' }));
    const all = () => world.names().filter((one) => one === 'search').length;
    const earlier = all(); // for the members of logical components
    const searches = () => all() - earlier;
    store.matches.look_for(condition_of(of({}), []), () => true);
    store.matches.look_for(condition_of(draft, references_of(store.known.value, draft)), () => true);
    expect(searches()).toBe(0);
    await world.passes(300);
    expect(searches()).toBe(1);
    expect(world.requests.at(-1)?.child('condition')).toBeDefined();
    expect(store.matches.found.value).toEqual({ refs: ['person_localization', 'speech_synthesis'], trouble: undefined, is_old: false });
    expect(console.documents.ring.list().filter((one) => one.name === 'search').every((one) => one.is_own)).toBe(true);
    world.answers.set('search', () => 'BAD_PARAMETER');
    await world.passes(2000);
    expect(store.matches.found.value?.trouble).toBeInstanceOf(Error);
    stop();
    const before = searches();
    await world.passes(10_000);
    expect(searches()).toBe(before);
  });
});

test('a draft is stored across visits, and invalid data is ignored', async () => {
  const { console, store } = await connected();
  store.change_root((root) => with_added(root, root.id, new_predicate({ reference: 'status', value: 'READY' })));
  expect(plain(new ConditionStore(console).draft.value)).toEqual(plain(store.draft.value));
  for (const text of [undefined, '', '{}', '[]', '{"purpose":"search"}', 'null']) expect(draft_of(text)).toBeUndefined();
  expect(plain(draft_of(draft_text(store.draft.value)))).toEqual(plain(store.draft.value));
});

test('a subscription made here is ended here', async () => {
  const { world, store } = await connected();
  world.answers.set('subscribe', () => '<subscribe_id>s-9</subscribe_id>');
  await store.subscribe('person_localized', condition_of(of({}), []), true);
  expect(store.subscribed.value.map((one) => one.subscribe_id)).toEqual(['s-9']);
  expect(world.requests.at(-1)?.child('condition')).toBeUndefined();
  await store.unsubscribe(store.subscribed.value[0]!);
  expect(world.names().at(-1)).toBe('unsubscribe');
  expect(store.subscribed.value).toEqual([]);
});
