// Rows for sessions, limits and problems from /metrics. Older gateways have fewer metrics, so fewer rows.
import type { Scrape } from '../state/engine/metrics_state';

export interface SessionRow {
  number: string;
  is_mine: boolean;
  age: number; // ms
  bound: string[]; // refs
  commands: number;
  subscriptions: number;
  waiting: number; // notifications
}

const same_time = 1500; // ms

/** `begun`: the begin of this console's session. */
export function sessions_in(scrape: Scrape, mine: ReadonlySet<string>, begun: number): SessionRow[] {
  const of = (name: string, session: string) => scrape.value(name, { session }) ?? 0;
  const rows = scrape.all('rois_session_age_seconds').map(({ labels, value }): SessionRow => {
    const number = labels['session'] ?? '';
    const bound = scrape
      .all('rois_component_bound')
      .filter((one) => one.value > 0 && one.labels['session'] === number)
      .map((one) => one.labels['component_ref'] ?? '');
    return {
      number,
      is_mine: false,
      age: value * 1000,
      bound: bound.sort(),
      commands: of('rois_session_commands', number),
      subscriptions: of('rois_session_subscriptions', number),
      waiting: of('rois_session_notifications_waiting', number),
    };
  });
  const own = own_of(rows, scrape.at, mine, begun);
  if (own) own.is_mine = true;
  return rows.sort((a, b) => Number(a.number) - Number(b.number));
}

// The row of this console. A session does not know its number, so it is found by its bindings or its begin.
function own_of(rows: SessionRow[], at: number, mine: ReadonlySet<string>, begun: number): SessionRow | undefined {
  const by_bound = rows.filter((row) => row.bound.some((ref) => mine.has(ref)));
  if (by_bound.length === 1) return by_bound[0];
  const by_time = rows.filter((row) => Math.abs(at - row.age - begun) <= same_time);
  return by_time.length === 1 ? by_time[0] : undefined;
}

export interface LimitRow {
  name: string;
  now: number | undefined;
  most: number;
  reached: number; // since the gateway started
  lately: number; // in the stored history
}

export function limits_in(latest: Scrape, oldest: Scrape | undefined): LimitRow[] {
  return latest.all('rois_limit').map(({ labels, value: most }): LimitRow => {
    const name = labels['limit'] ?? '';
    const reached = latest.value('rois_limit_reached_total', { limit: name }) ?? 0;
    return {
      name,
      now: now_of(name, latest),
      most,
      reached,
      lately: grown(reached, oldest?.value('rois_limit_reached_total', { limit: name })),
    };
  });
}

// The session nearest to the limit, if the limit is for each session.
function now_of(name: string, scrape: Scrape): number | undefined {
  const most_of_one = (metric: string) => {
    const values = scrape.all(metric).map((one) => one.value);
    return values.length === 0 ? undefined : Math.max(...values);
  };
  switch (name) {
    case 'sessions':
      return scrape.value('rois_sessions');
    case 'connections':
      return scrape.value('rois_connections');
    case 'commands':
      return most_of_one('rois_session_commands');
    case 'waiting_notifications':
      return most_of_one('rois_session_notifications_waiting');
    default:
      return undefined;
  }
}

export interface TroubleRow {
  name: string; // of the metric
  detail: string; // code, status
  count: number; // since the gateway started
  lately: number;
}

const troubles: [metric: string, label: string, fine: string[]][] = [
  ['rois_faults_total', 'code', []],
  ['rois_commands_completed_total', 'status', ['OK']],
  ['rois_requests_total', 'return_code', ['OK']],
  ['rois_errors_total', '', []],
  ['rois_connections_cut_total', '', []],
  ['rois_notifications_lost_total', '', []],
  ['rois_stray_component_answers_total', '', []],
];

/** Problems since the gateway started; counters at 0 are omitted. */
export function troubles_in(latest: Scrape, oldest: Scrape | undefined): TroubleRow[] {
  return troubles.flatMap(([name, label, fine]) => {
    const kinds = label === '' ? [''] : [...new Set(latest.all(name).map((one) => one.labels[label] ?? ''))];
    return kinds
      .filter((kind) => !fine.includes(kind))
      .map((detail): TroubleRow => {
        const labels: Record<string, string> = label === '' ? {} : { [label]: detail };
        const count = latest.value(name, labels) ?? 0;
        return { name, detail, count, lately: grown(count, oldest?.value(name, labels)) };
      })
      .filter((row) => row.count > 0);
  });
}

// A counter that is new was 0 before.
function grown(now: number, before = 0): number {
  return now >= before ? now - before : now;
}
