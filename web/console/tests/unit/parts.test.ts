// Small parts of state and widgets.
import { parse_xml } from 'rois-client';
import { describe, expect, test } from 'vitest';

import { language, duration, wished_language } from '../../src/i18n/i18n';
import { Ring } from '../../src/state/base/ring';
import { read_metrics, Scrape } from '../../src/state/engine/metrics_state';
import { read_floor_map } from '../../src/state/floor/floor_map';
import { ellipse_of } from '../../src/state/floor/things';
import { Notices } from '../../src/state/notices';
import { Documents } from '../../src/state/session/documents';
import { placed_commands, units_of } from '../../src/state/session/sequences';
import { tried } from '../../src/ui/error_text';
import { curl_of } from '../../src/ui/xml/curl';
import { laid_out, pieces_of } from '../../src/ui/xml/xml_text';
import { World } from './world';

describe('notices', () => {
  test('are at most two, expire (errors later), and are removed when their subject succeeds', async () => {
    const world = new World();
    const notices = new Notices(world);
    const texts = () => notices.list.value.map((one) => one.text);
    for (const text of ['a', 'b', 'c']) notices.show('error', text, { about: text });
    expect(texts()).toEqual(['b', 'c']);
    tried({ notices }, 'b', Promise.resolve());
    tried({ notices }, 'c', Promise.reject(new Error('again')));
    await world.passes(0);
    expect(texts()).toEqual(['again']);
    notices.show('good', 'd');
    await world.passes(8000);
    expect(texts()).toEqual(['again']);
    await world.passes(22_000);
    expect(texts()).toEqual([]);
  });
});

describe('a ring', () => {
  test('drops the oldest by number', () => {
    const ring = new Ring<number>(3);
    for (let i = 0; i < 1000; ++i) ring.push(i);
    expect(ring.list()).toEqual([997, 998, 999]);
    expect([ring.size, ring.first, ring.at(0), ring.at(-1), ring.numbered(998), ring.numbered(996)]).toEqual([3, 997, 997, 999, 998, undefined]);
  });
  test('drops the oldest by weight, but keeps one', () => {
    const ring = new Ring<string>(100, 10, (one) => one.length);
    for (const one of ['aaaa', 'bbbb', 'cccc', 'd'.repeat(50)]) ring.push(one);
    expect(ring.list()).toEqual(['d'.repeat(50)]);
    expect(ring.bytes).toBe(50);
  });
});

test('documents stay within their limits', () => {
  const documents = new Documents(new World(), { most: 1000, most_bytes: 100_000 });
  for (let i = 0; i < 5000; ++i) documents.note('in', `<receive_event sequence="${i}">${'x'.repeat(500)}</receive_event>`);
  expect(documents.ring.size).toBeLessThan(100);
  expect(documents.ring.bytes).toBeLessThanOrEqual(100_000);
  expect(documents.ring.last).toMatchObject({ kind: 'notification', sequence: 4999 });
});

test("the console's polls do not displace other documents", () => {
  const documents = new Documents(new World(), { most: 100, most_bytes: 1_000_000 });
  for (let i = 0; i < 90; ++i) documents.note('in', `<receive_event sequence="${i}"/>`);
  for (let i = 0; i < 500; ++i) {
    documents.as_own(() => documents.note('out', '<query/>'));
    documents.note('in', '<query_response return_code="OK"/>');
  }
  documents.note('out', '<execute/>');
  const { ring } = documents;
  expect([ring.size, ring.first, ring.end, ring.last?.name]).toEqual([101, 0, 1091, 'execute']);
  expect([ring.numbered(89)?.name, ring.numbered(90), ring.numbered(1089)?.name]).toEqual(['receive_event', undefined, 'query_response']);
  const numbers = ring.list().map((one) => one.number);
  expect(numbers).toEqual([...numbers].sort((a, b) => a - b));
});

test('metrics are parsed', () => {
  const scrape = new Scrape(0, read_metrics('# TYPE a counter\na{x="1",y="q\\"\\n"} 2\na{x="2"} 3e1\nb +Inf\nnonsense\n'));
  expect(scrape.value('a')).toBe(32);
  expect(scrape.value('a', { x: '2' })).toBe(30);
  expect(scrape.all('a')[0]?.labels['y']).toBe('q"\n');
  expect(scrape.value('b')).toBe(Infinity);
  expect(scrape.value('c')).toBeUndefined();
});

test('a floor map is parsed', () => {
  const map = read_floor_map(`<floor_map xmlns="urn:x-rois:map:1" name="Hall" crs="c"><bounds x="0" y="0" width="16000" depth="12000"/>
    <wall x1="1" y1="2" x2="3" y2="4"/><furniture x="5" y="6" width="7" depth="8"/><place name="desk" x="9" y="10" heading="90" width="11" depth="12"/>
    <robot name="robot1" radius="250"><frame crs="d" x="1" y="2" heading="3"/></robot><robot name="robot2" radius="300"/></floor_map>`);
  expect(map).toMatchObject({ name: 'Hall', bounds: { width: 16000, depth: 12000 }, walls: [{ x1: 1, y2: 4 }], furniture: [{ depth: 8 }] });
  expect(map.places).toEqual([{ name: 'desk', x: 9, y: 10, heading: 90, width: 11, depth: 12 }]);
  expect(map.robots).toEqual([{ name: 'robot1', radius: 250, frame: { crs: 'd', x: 1, y: 2, heading: 3 } }, { name: 'robot2', radius: 300 }]);
});

test('a sequence is parsed with the paths of its commands', () => {
  const command = (name: string, id: string) =>
    `<rois:${name} xsi:type="rois:CommandMessageType" rois:command_type="start" rois:command_id="${id}" rois:delay_time="5"><rois:component_ref rois:code="c"/></rois:${name}>`;
  const units = units_of(
    parse_xml(`<execute xmlns:rois="http://www.omg.org/spec/RoIS/20240801" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"><rois:CommandUnitSequence>
      ${command('command_unit_list', 'a')}<rois:command_unit_list rois:delay_time="200"/>
      <rois:command_unit_list xsi:type="rois:ConcurrentCommandsType"><rois:branch_list>${command('command_list', 'b')}${command('command_list', 'c')}</rois:branch_list><rois:branch_list>${command('command_list', 'd')}</rois:branch_list></rois:command_unit_list>
      <rois:command_unit_list xsi:type="rois:ParallelCommandUnitType">${command('command_unit_list', 'e')}</rois:command_unit_list>
      </rois:CommandUnitSequence></execute>`),
  );
  expect(units.map((one) => one.kind)).toEqual(['command', 'delay', 'concurrent', 'parallel']);
  expect(placed_commands(units).map(({ path, command: { command_id } }) => `${command_id} ${path}`)).toEqual([
    'a command_unit_list[1]',
    'b command_unit_list[3]/branch_list[1]/command_list[1]',
    'c command_unit_list[3]/branch_list[1]/command_list[2]',
    'd command_unit_list[3]/branch_list[2]/command_list[1]',
    'e command_unit_list[4]/command_unit_list[1]',
  ]);
});

test('a covariance becomes an ellipse', () => {
  expect(ellipse_of({ covariance: [2500, 0, 0, 0, 900, 0, 0, 0, 4] })).toEqual({ a: 50, b: 30, angle: 0 });
  expect(ellipse_of({ covariance: [5, 4, 4, 5] })).toEqual({ a: 3, b: 1, angle: 45 });
  expect(ellipse_of({})).toBeUndefined();
});

describe('displayed XML', () => {
  const text = '<a x="1"><!-- c --><b>t &amp; u</b><c y=\'>\'/></a>';
  test('is complete and coloured', () => {
    expect(pieces_of(text).map((one) => one.text).join('')).toBe(text);
    expect(pieces_of('<a x="1">t</a>').map(({ kind, text: piece }) => `${kind} ${piece}`)).toEqual([
      'mark <', 'name a', 'mark  ', 'attribute x', 'mark =', 'value "1"', 'mark >', 'text t', 'mark </', 'name a', 'mark >',
    ]);
  });
  test('has one element on each line', () => {
    expect(laid_out(text)).toBe('<a x="1">\n  <!-- c -->\n  <b>t &amp; u</b>\n  <c y=\'>\'/>\n</a>');
  });
  test('stays unchanged if it is invalid', () => {
    for (const odd of ['', 'hello', '<a><b></a>', '<<<', '<a']) {
      expect(laid_out(odd)).toBe(odd);
      expect(pieces_of(odd).map((one) => one.text).join('')).toBe(odd);
    }
  });
});

test('a curl line is quoted for the shell, and has no request_id', () => {
  expect(curl_of(`<say xmlns="u" request_id="r7"><text>it's</text></say>`, { origin: 'http://h:1', session: 's-1', token: 't' })).toBe(
    `curl -s -H 'Content-Type: application/xml' -H 'RoIS-Session: s-1' -H 'Authorization: Bearer t' -d '<say xmlns="u"><text>it'\\''s</text></say>' http://h:1/rois`,
  );
});

test('the first supported language is chosen, and durations have one unit', () => {
  expect(wished_language(['de', 'ja-JP', 'en'])).toBe('ja');
  expect(wished_language([])).toBe('en');
  expect([400, 1200, 12_000, 180_000, 7_200_000].map(duration)).toEqual(['400 ms', '1.2 s', '12 s', '3 min', '2 h']);
  language.value = 'ja';
  expect(duration(12_000)).toBe('12秒');
  language.value = 'en';
});
