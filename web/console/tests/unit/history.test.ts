// History and traffic of the state.
import { beforeEach, describe, expect, test } from 'vitest';

import { log_of, reason_of } from '../../src/health/log';
import type { Console } from '../../src/state/console';
import { Console as Another } from '../../src/state/console';
import { History, type Span } from '../../src/state/history';
import { keep, restore } from '../../src/state/keeping';
import { median } from '../../src/state/session/traffic';
import { of_mark } from '../../src/timeline/describe';
import { profile_xml, settled, World } from './world';

let world: World;
let console: Console;
let status = 'READY';

beforeEach(async () => {
  world = new World();
  status = 'READY';
  world.answers.set('get_profile', () => profile_xml({ navigation: { type: 'Navigation' } }));
  world.answers.set('query', () => `<component_ref rois:code="navigation"/><results><result rois:name="status"><rois:data_type_ref rois:code="Component_Status"/><rois:value>${status}</rois:value></result></results>`);
  world.pages.set('/rois/map', { status: 404, text: '' });
  world.pages.set('/metrics', { status: 200, text: '' });
  console = await world.console();
});

/** `READY 0-2000`, in ms from the start. */
function spans_of(history: History, kind: Span['kind']): string[] {
  const spans = [...history.past, ...history.present.values()].filter((one) => one.kind === kind).sort((a, b) => a.number - b.number);
  return spans.map(({ value, from, to }) => `${value} ${from - began}-${to - began}`);
}
const began = Date.UTC(2026, 10, 20, 12);

describe('history', () => {
  test('has the periods of each status', async () => {
    const stop = console.history.record();
    await settled();
    await world.passes(2000);
    status = 'BUSY';
    await world.passes(3000);
    expect(spans_of(console.history, 'status')).toEqual(['READY 0-3000', 'BUSY 3000-5000']);
    stop();
    await world.passes(3000);
    expect(spans_of(console.history, 'status')).toEqual(['READY 0-3000', 'BUSY 3000-5000']);
  });

  test('has nothing for the time of a lost link', async () => {
    console.history.record();
    await settled();
    await world.passes(2000);
    world.breaks();
    await world.passes(40);
    await world.tries_again();
    await world.passes(4960);
    await world.opens();
    await world.passes(1000);
    expect(spans_of(console.history, 'status')).toEqual(['READY 0-2000', 'READY 7000-8000']);
    expect(spans_of(console.history, 'link')).toEqual(['open 0-2000', 'lost 2000-7000', 'resumed 7000-8000']);
  });

  test('reports a loss once with its reason, however many retries fail', async () => {
    console.history.record();
    await world.passes(2000);
    world.breaks();
    await world.passes(40);
    const why = console.link.view.value.reason;
    console.link.set_phase('lost', 'the WebSocket could not be opened');
    await world.passes(1960);
    expect(spans_of(console.history, 'link')).toEqual(['open 0-2000', 'lost 2000-4000']);
    expect(console.history.present.get('link ')!.note).toBe(why);
  });

  test('has the owners of components', async () => {
    const bound = (session: string) => ({ status: 200, text: `rois_component_bound{component_ref="navigation",session="${session}"} 1\n` });
    console.history.record();
    await world.passes(1000);
    await console.bindings.bind('navigation');
    world.pages.set('/metrics', bound('1'));
    await world.passes(2000);
    await console.bindings.release('navigation');
    world.pages.set('/metrics', bound('7'));
    await world.passes(3000);
    world.pages.set('/metrics', { status: 200, text: '' });
    await world.passes(2000);
    expect(spans_of(console.history, 'holder').map((one) => one.split(' ')[0])).toEqual(['me', '7']);
    expect([...console.history.present.values()].map((one) => one.kind)).not.toContain('holder');
  });

  test('is bounded', async () => {
    const history = new History(world, console, 10);
    history.record();
    for (let i = 0; i < 100; ++i) {
      status = i % 2 === 0 ? 'BUSY' : 'READY';
      await world.passes(1000);
    }
    expect(history.past.size).toBe(10);
    expect(history.present.size).toBe(2);
  });
});

describe('traffic', () => {
  test('counts by second, and has the response times', async () => {
    await world.passes(1000);
    for (let i = 0; i < 100; ++i) await console.client.search();
    const second = console.traffic.seconds.at(-1)!;
    expect(second).toMatchObject({ sent: 100, received: 100, at: began + 1000 });
    expect(second.tooks).toHaveLength(64);
    expect(second.slowest?.name).toBe('search_response');
  });

  test('sends a light request while watched and idle', async () => {
    await world.passes(3000);
    const before = world.requests.length;
    await world.passes(3000);
    expect(world.requests.length).toBe(before);
    const stop = console.traffic.ping.watch();
    await settled();
    await world.passes(2000);
    expect(world.names().slice(before)).toEqual(['search', 'search', 'search']);
    stop();
    console.status.poll.watch();
    await world.passes(100);
    console.traffic.ping.watch();
    await world.passes(5000);
    expect(world.names().slice(before + 3).filter((name) => name === 'search')).toEqual([]);
  });

  test("keeps refusals, except of the console's own requests", async () => {
    world.answers.set('search', () => 'ERROR');
    await console.client.search().catch(() => undefined);
    await console.documents.as_own(() => console.client.search()).catch(() => undefined);
    expect(console.traffic.refused.list().map((one) => one.name)).toEqual(['search_response']);
  });

  test('keeps two minutes', async () => {
    for (let i = 0; i < 200; ++i) {
      await world.passes(1000);
      world.says(`<profile_changed xmlns="urn:x-rois:psm:xml:message:1" sequence="${i + 1}"/>`);
      await settled();
    }
    expect(console.traffic.seconds.size).toBe(120);
  });

  test('the median is the middle value', () => {
    expect([[], [3], [5, 1], [9, 1, 2]].map(median)).toEqual([undefined, 3, 3, 2]);
  });
});

describe('a reload', () => {
  const kept = () => {
    const texts: string[] = [];
    keep(console, (text) => texts.push(text) > 0);
    return texts.at(-1);
  };
  const reloaded = () => {
    const another = new Another(world);
    restore(another, kept());
    return another;
  };

  test('leaves gaps, switches, and refusals with their reasons', async () => {
    world.answers.set('bind', () => 'ERROR');
    world.reasons.set('bind', 'navigation &lt;is&gt; taken');
    await console.bindings.bind('navigation').catch(() => undefined);
    console.events.gap({ reason: 'lost', first: 1, last: 3, count: 3 });
    await world.notifies('switched', '<component_ref rois:code="navigation"/><from>a.navigation</from><to>b.navigation</to><reason>it failed</reason>');
    const before = console.traffic.refused.at(0)!;
    const after = reloaded();
    const [refused] = after.traffic.refused.list();
    expect(of_mark({ kind: 'refused', entry: refused! })).toEqual(of_mark({ kind: 'refused', entry: before }));
    expect(of_mark({ kind: 'refused', entry: refused! })).toMatchObject({ title: 'bind', component: 'navigation', state: 'ERROR' });
    expect(reason_of(refused!)).toBe('navigation <is> taken');
    expect(after.events.gaps.list()).toEqual(console.events.gaps.list());
    expect(after.events.switches.at(0)!.switched).toEqual(console.events.switches.at(0)!.switched);
    expect(log_of(after).map((one) => one.kind).sort()).toEqual(['gap', 'refused']);
    expect(after.documents.ring.numbered(refused!.number)).toBeUndefined();
    console = after;
    expect(reason_of(reloaded().traffic.refused.at(0)!)).toBe('navigation <is> taken'); // parsed from XML again
  });

  test('stores fewer rows if the browser refuses more', () => {
    for (let i = 0; i < 500; ++i) console.events.gaps.push({ at: i, gap: { reason: 'lost', first: i, last: i, count: 1 } });
    const sizes: number[] = [];
    keep(console, (text) => sizes.push((JSON.parse(text) as { gaps: unknown[] }).gaps.length) > 2);
    expect(sizes).toEqual([100, 100, 40]);
  });
});
