// The list of documents, their summaries, and recordings.
import { describe, expect, test } from 'vitest';

import { category_of, Feed, type Filter, is_gap, no_filter, type Source } from '../../src/messages/feed';
import { component_of, expire_of, summary } from '../../src/messages/summary';
import { Ring } from '../../src/state/base/ring';
import type { LoggedDocument } from '../../src/state/session/document_log';
import { Documents } from '../../src/state/session/documents';
import type { GapEntry } from '../../src/state/session/events_state';
import { read_recording, recording_of } from '../../src/state/session/recording';
import { World } from './world';

const event = '<receive_event xmlns="urn:m" sequence="1"><event_type>person_detected</event_type><expire>2026-11-20T12:01:00Z</expire><component_ref rois:code="person_detection"/><results><result rois:name="timestamp"><rois:value>2026-11-20T12:00:00Z</rois:value></result><result rois:name="number"><rois:data_type_ref rois:code="int"/><rois:value>2</rois:value></result></results></receive_event>';
const completed = '<completed sequence="2"><command_id>c-1</command_id><status>ERROR</status></completed>';
const execute = '<execute xmlns:rois="r"><rois:CommandUnitSequence><rois:command_unit_list xsi:type="rois:CommandMessageType" rois:command_type="start" rois:command_id=""><rois:component_ref rois:code="navigation"/></rois:command_unit_list></rois:CommandUnitSequence></execute>';
const refused = '<execute_response return_code="BAD_PARAMETER"><reason>command_unit_list[1]: &quot;x&quot; &amp; so on</reason></execute_response>';

function stage(most = 100) {
  const world = new World();
  const documents = new Documents(world, { most, most_bytes: Infinity });
  const gaps = new Ring<GapEntry>(10);
  const source: Source = { documents: documents.ring, gaps, component_of: (one) => one.component ?? (one.name === 'completed' ? 'navigation' : '') };
  const names = (feed: Feed) => feed.rows.map((row) => (is_gap(row) ? row.gap.reason : row.name));
  return { world, documents, gaps, source, names };
}

describe('the list', () => {
  test("is bounded with the console's own requests, which are dropped first", () => {
    const { documents, source } = stage(1000);
    const feed = new Feed(source, { ...no_filter, with_own: true });
    documents.note('in', event);
    for (let i = 0; i < 5000; ++i) {
      documents.as_own(() => documents.note('out', '<query/>'));
      feed.update();
    }
    expect(documents.ring.size).toBe(101);
    expect(feed.rows.length).toBeLessThan(1200);
    const [oldest] = feed.rows;
    expect(oldest && !is_gap(oldest) && oldest.name).toBe('receive_event');
  });

  test('adds new documents and drops forgotten ones', async () => {
    const { world, documents, gaps, source, names } = stage(3);
    const feed = new Feed(source, no_filter);
    expect(feed.update()).toBe(false);
    documents.note('out', execute);
    documents.note('in', refused);
    expect(feed.update()).toBe(true);
    expect(names(feed)).toEqual(['execute', 'execute_response']);
    await world.passes(1000);
    gaps.push({ at: world.now(), gap: { reason: 'session' } });
    await world.passes(1000);
    documents.note('in', event);
    documents.note('in', completed);
    expect(feed.update()).toBe(true);
    expect(names(feed)).toEqual(['execute_response', 'session', 'receive_event', 'completed']);
    documents.note('in', event);
    documents.note('in', event);
    feed.update();
    expect(names(feed)).toEqual(['completed', 'receive_event', 'receive_event']);
    expect(feed.update()).toBe(false);
  });

  test.each<[string, Partial<Filter>, string[]]>([
    ['all', {}, ['execute', 'execute_response', 'receive_event', 'completed']],
    ['by kind', { hidden: new Set(['event', 'request']) }, ['execute_response', 'completed']],
    ['refusals are errors', { hidden: new Set(['error']) }, ['execute', 'receive_event', 'completed']],
    ['by component, even if not named in the document', { component: 'navigation' }, ['execute', 'execute_response', 'completed']],
    ['by text', { text: 'PERSON_' }, ['receive_event']],
    ['own ones', { with_own: true }, ['execute', 'execute_response', 'query', 'query_response', 'receive_event', 'completed']],
  ])('is filtered: %s', (_, some, expected) => {
    const { documents, source, names } = stage();
    documents.note('out', execute);
    documents.note('in', refused);
    documents.as_own(() => documents.note('out', '<query><query_type>component_status</query_type></query>'));
    documents.note('in', '<query_response return_code="OK"/>');
    documents.note('in', event);
    documents.note('in', completed);
    expect(names(new Feed(source, { ...no_filter, ...some }))).toEqual(expected);
  });

  test('summarizes each document', () => {
    const { documents } = stage();
    const said = (direction: 'in' | 'out', text: string) => summary(documents.note(direction, text));
    expect(said('in', event)).toBe('number: 2');
    const localized = event.replace('person_detected', 'person_localized').replace('</results>', '<result rois:name="person_ref"><rois:value>person-1</rois:value></result><located of="position_data" ref="person-1" crs="hall"><position>1000 2000 0</position></located></results>');
    expect(said('in', localized)).toBe('person-1 1.00, 2.00 m  number: 2');
    expect(said('in', completed)).toBe('ERROR  c-1');
    expect(said('out', execute)).toBe('navigation start');
    expect(said('in', refused)).toBe('command_unit_list[1]: "x" & so on');
    expect(said('out', '<query><query_type>robot_position</query_type></query>')).toBe('robot_position');
    expect(said('in', '<search_response return_code="OK"><component_ref_list><component_ref rois:code="a"/><component_ref rois:code="b"/></component_ref_list></search_response>')).toBe('a, b');
    expect(said('in', 'no XML')).toBe('');
    expect(component_of(documents.note('in', event))).toBe('person_detection');
    expect(component_of(documents.note('out', '<query><condition><fes:Filter><fes:PropertyIsEqualTo><fes:ValueReference>component_ref</fes:ValueReference><fes:Literal>move</fes:Literal></fes:PropertyIsEqualTo></fes:Filter></condition></query>'))).toBe('move');
    expect(expire_of(documents.note('in', event))).toBe(Date.UTC(2026, 10, 20, 12, 1));
    expect(expire_of(documents.note('in', completed))).toBeUndefined();
    expect(category_of(documents.note('in', '<fault code="invalid"><reason>r</reason></fault>'))).toBe('error');
    expect(category_of(documents.note('in', '<profile_changed sequence="1"/>'))).toBe('notice');
  });
});

describe('recordings', () => {
  test('are written in the format of rois record', async () => {
    const { world, documents } = stage();
    documents.note('out', '<connect/>');
    await world.passes(12);
    documents.note('in', '<connect_response return_code="OK"><session>s</session></connect_response>');
    expect(recording_of(documents.ring, 'http://engine.example')).toEqual([
      '{"recording":"rois-recording-1","url":"http://engine.example","begun":"2026-11-20T12:00:00.000Z"}\n',
      '{"at":0,"direction":"out","document":"<connect/>"}\n',
      '{"at":0.012,"direction":"in","document":"<connect_response return_code=\\"OK\\"><session>s</session></connect_response>"}\n',
    ]);
  });

  test('mark sessions, and are read back', async () => {
    const { world, documents } = stage();
    for (const text of ['<connect/>', '<bind/>', '<connect/>', execute]) documents.note('out', text);
    await world.passes(5);
    const file = recording_of(documents.ring, 'http://engine.example').join('');
    expect([...file.matchAll(/"session":"(\d)"/g)].map(([, n]) => n)).toEqual(['1', '1', '2', '2']);
    const read = read_recording(file);
    expect(read).toMatchObject({ url: 'http://engine.example', begun: '2026-11-20T12:00:00.000Z' });
    expect([read.is_cut, read_recording(file.slice(0, -9))]).toMatchObject([false, { is_cut: true, documents: { length: 3 } }]);
    expect(read.documents.map((one: LoggedDocument) => [one.number, one.name, one.at])).toEqual([
      [0, 'connect', world.now() - 5],
      [1, 'bind', world.now() - 5],
      [2, 'connect', world.now() - 5],
      [3, 'execute', world.now() - 5],
    ]);
  });

  test('pair answers with the requests of their own session', () => {
    const line = (session: string, direction: string, document: string) => JSON.stringify({ at: 1, direction, session, document });
    const { documents } = read_recording(
      [
        '{"recording":"rois-recording-1"}',
        line('a', 'out', '<search/>'),
        line('b', 'out', execute),
        line('a', 'in', '<search_response return_code="OK"/>'),
        line('b', 'in', refused),
        '',
      ].join('\n'),
    );
    expect(documents[2]!.request).toBe(documents[0]);
    expect(documents[3]!.request).toBe(documents[1]);
    expect(documents[3]!.component).toBe('navigation');
  });

  test.each([
    ['', 'the recording is empty'],
    ['hello', 'line 1: not a JSON object'],
    ['{"recording":"rois-recording-1"}\n{"at":0,', 'the recording is empty'],
    ['{"recording":"rois-recording-1"}\n{"at":0,\n', 'line 2: not a JSON object'],
    ['{"recording":"other"}', 'line 1: expected a recording of the format rois-recording-1'],
    ['{"recording":"rois-recording-1"}\n', 'the recording is empty'],
    ['{"recording":"rois-recording-1"}\n{"at":0,"direction":"up","document":""}', 'line 2: \'direction\' must be "in" or "out"'],
    ['{"recording":"rois-recording-1"}\n{"at":"0","direction":"in","document":""}', "line 2: 'at' (a number) or 'document' (a text) is missing"],
    ['{"recording":"rois-recording-1"}\n7', 'line 2: not a JSON object'],
  ])('that are invalid are rejected: %j', (file, why) => expect(() => read_recording(file)).toThrow(why));
});
