// Values of the Health panel.
import { command } from 'rois-client';
import { beforeEach, describe, expect, test } from 'vitest';

import { limits_in, sessions_in, troubles_in } from '../../src/health/counters';
import { log_of, reason_of, refused_component } from '../../src/health/log';
import { documents_a_second, growth, highest, inside, latencies, point_near } from '../../src/health/series';
import type { Console } from '../../src/state/console';
import { read_metrics, Scrape } from '../../src/state/engine/metrics_state';
import type { Second } from '../../src/state/session/traffic';
import { profile_xml, settled, World } from './world';

const scrape = (at: number, text: string) => new Scrape(at, read_metrics(text));

describe('the series', () => {
  const seconds: Second[] = [
    { at: 1000, sent: 2, received: 3, tooks: [1, 9, 2] },
    { at: 3000, sent: 1, received: 0, tooks: [] },
    { at: 4000, sent: 1, received: 1, tooks: [4] },
  ];
  test('of latency has the median and maximum of each second, and no points without answers', () => {
    const { middle, slowest } = latencies(seconds, 0);
    expect(middle).toEqual([{ at: 1000, value: 2 }, { at: 4000, value: 4 }]);
    expect(slowest).toEqual([{ at: 1000, value: 9 }, { at: 4000, value: 4 }]);
    expect(latencies(seconds, 2000).middle).toHaveLength(1);
  });
  test('of documents is 0 in a second without documents, and omits the current second', () => {
    expect(documents_a_second(seconds, 0, 4500, (one) => one.sent)).toEqual([{ at: 1000, value: 2 }, { at: 2000, value: 0 }, { at: 3000, value: 1 }]);
    expect(documents_a_second([], 0, 4500, (one) => one.sent)).toEqual([]);
  });
  test('of a counter is its growth per second, with a gap at a restart of the gateway', () => {
    const history = [0, 1000, 2000, 3000, 9000, 10_000].map((at, i) => scrape(at, `n ${[10, 14, 14, 2, 8, 9][i]}\n`));
    expect(growth(history, 0, (one) => one.value('n'))).toEqual([{ at: 1000, value: 4 }, { at: 2000, value: 0 }, { at: 10_000, value: 1 }]);
    expect(growth(history, 0, (one) => one.value('m'))).toEqual([]);
  });
  test('of the time inside the gateway is the mean per request', () => {
    const history = [0, 1000, 2000].map((at, i) => scrape(at, `rois_request_duration_seconds_sum ${[0, 0.01, 0.01][i]}\nrois_request_duration_seconds_count ${[0, 5, 5][i]}\n`));
    expect(inside(history, 0)).toEqual([{ at: 1000, value: 2 }]);
  });
  test('finds a point by its time', () => {
    const series = [{ at: 1000, value: 1 }, { at: 2000, value: 5 }];
    expect(point_near(series, 1600)).toEqual({ at: 2000, value: 5 });
    expect(point_near(series, 9000)).toBeUndefined();
    expect([highest(series), highest([])]).toEqual([5, undefined]);
  });
});

describe('counters', () => {
  const text = `rois_sessions 3
rois_session_age_seconds{session="10"} 1
rois_session_age_seconds{session="2"} 60
rois_session_age_seconds{session="3"} 30
rois_session_commands{session="3"} 4
rois_session_subscriptions{session="2"} 7
rois_component_bound{component_ref="navigation",session="3"} 1
rois_component_bound{component_ref="follow",session="3"} 1
rois_limit{limit="sessions"} 3
rois_limit{limit="commands"} 1024
rois_limit_reached_total{limit="sessions"} 5
rois_limit_reached_total{limit="commands"} 0
`;
  test('list the sessions in order, with their bindings', () => {
    const rows = sessions_in(scrape(100_000, text), new Set(), 99_400);
    expect(rows.map(({ number, is_mine, bound }) => [number, is_mine, bound])).toEqual([
      ['2', false, []],
      ['3', false, ['follow', 'navigation']],
      ['10', true, []],
    ]);
    expect(rows[1]).toMatchObject({ commands: 4, subscriptions: 0, age: 30_000 });
  });
  test("identify the console's own session by its bindings, without guessing", () => {
    const mine = (bound: string[], begun: number) => sessions_in(scrape(100_000, text), new Set(bound), begun).filter((one) => one.is_mine).map((one) => one.number);
    expect(mine(['follow'], 0)).toEqual(['3']);
    expect(mine([], 40_300)).toEqual(['2']);
    expect(mine([], 0)).toEqual([]);
  });
  test('list the limits with their use, and how often each was reached', () => {
    expect(limits_in(scrape(0, text), scrape(0, 'rois_limit_reached_total{limit="sessions"} 3\n'))).toEqual([
      { name: 'sessions', now: 3, most: 3, reached: 5, lately: 2 },
      { name: 'commands', now: 4, most: 1024, reached: 0, lately: 0 },
    ]);
    expect(limits_in(scrape(0, 'rois_sessions 1\n'), undefined)).toEqual([]);
  });
  test('list only problems that occurred', () => {
    const now = scrape(0, 'rois_faults_total{code="invalid"} 2\nrois_faults_total{code="too_many"} 0\nrois_requests_total{operation="bind",return_code="OK"} 9\nrois_requests_total{operation="bind",return_code="ERROR"} 1\nrois_notifications_lost_total 4\n');
    expect(troubles_in(now, scrape(0, 'rois_notifications_lost_total 4\n'))).toEqual([
      { name: 'rois_faults_total', detail: 'invalid', count: 2, lately: 2 },
      { name: 'rois_requests_total', detail: 'ERROR', count: 1, lately: 1 },
      { name: 'rois_notifications_lost_total', detail: '', count: 4, lately: 0 },
    ]);
  });
});

describe('the log', () => {
  let world: World;
  let console: Console;
  beforeEach(async () => {
    world = new World();
    world.answers.set('get_profile', () => profile_xml({ navigation: { type: 'Navigation' } }));
    world.pages.set('/rois/map', { status: 404, text: '' });
    console = await world.console();
  });

  test('has errors with details, refusals, gaps and lost links; newest first', async () => {
    world.answers.set('get_error_detail', () => '<results><result rois:name="text"><rois:data_type_ref rois:code="string"/><rois:value>a wheel is stuck</rois:value></result></results>');
    world.answers.set('bind', () => 'OUT_OF_RESOURCES');
    console.history.record();
    await world.notifies('receive_error', '<error_id>x</error_id><error_type>COMPONENT_INTERNAL_ERROR</error_type><component_ref rois:code="navigation"/>');
    await world.passes(1000);
    await console.bindings.bind('navigation').catch(() => undefined);
    await world.passes(1000);
    world.says('<profile_changed xmlns="urn:x-rois:psm:xml:message:1" sequence="5"/>');
    await settled();
    await world.passes(1000);
    world.breaks('gone');
    const log = log_of(console);
    expect(log.map((one) => one.kind)).toEqual(['link', 'gap', 'refused', 'error']);
    const [link, , refused, error] = log;
    expect(link).toMatchObject({ span: { value: 'lost', note: 'gone' } });
    expect(refused?.kind === 'refused' && reason_of(refused.document)).toBe('so it is');
    expect(error?.kind === 'error' && error.entry.details).toMatchObject({ state: 'there' });
    expect(new Set(log.map((one) => one.key)).size).toBe(4);
  });

  test('has failed commands, and the component of a refused sequence', async () => {
    const unit = '<rois:command_unit_list xsi:type="rois:CommandMessageType" rois:command_type="start" rois:command_id="c1"><rois:component_ref rois:code="navigation"/></rois:command_unit_list>';
    world.answers.set('execute', () => `<rois:CommandUnitSequence>${unit}</rois:CommandUnitSequence>`);
    await console.run('navigation', 'start');
    await world.notifies('completed', '<command_id>c1</command_id><status>ERROR</status>');
    const [failed] = log_of(console);
    expect(failed).toMatchObject({ kind: 'command', command: { component: 'navigation', state: 'ERROR' } });
    expect(failed?.kind === 'command' && console.documents.ring.numbered(failed.command.completed!)?.name).toBe('completed');

    world.answers.set('execute', () => 'BAD_PARAMETER');
    const both = [command('navigation', 'start'), command('reaction', 'start')];
    for (const [reason, ref] of [['command_unit_list[2]: no such reaction', 'reaction'], ['something else', 'navigation, reaction']] as const) {
      world.reasons.set('execute', reason);
      await console.client.execute(both).catch(() => undefined);
      expect(refused_component(console.traffic.refused.at(-1)!)).toBe(ref);
    }
  });
});
