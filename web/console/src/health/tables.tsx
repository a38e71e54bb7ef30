// Tables of sessions, limits and the gateway's error counters.
import { useConsole } from '../context';
import { count_text, duration } from '../i18n/i18n';
import { Badge, Table } from '../ui';
import { type LimitRow, limits_in, type SessionRow, sessions_in, type TroubleRow, troubles_in } from './counters';
import * as t from './texts';

export function Sessions() {
  const { metrics, bindings, link } = useConsole();
  const scrape = metrics.latest.value;
  const mine = bindings.mine.value;
  const rows = scrape ? sessions_in(scrape, mine, link.session_since) : [];
  return (
    <section class="health-part">
      <h3>{t.sessions()}</h3>
      {!scrape ? (
        <p>{t.no_metrics()}</p>
      ) : rows.length === 0 ? (
        <p>
          {t.sessions_without_details(count_text(scrape.value('rois_sessions') ?? 0))} <Refs refs={[...mine].sort()} />
        </p>
      ) : (
        <Table<SessionRow>
          label={t.sessions()}
          rows={rows}
          key_of={(row) => row.number}
          columns={[
            { id: 'number', title: t.session(), cell: (row) => <>{row.number} {row.is_mine && <Badge tone="good">{t.mine()}</Badge>}</> },
            { id: 'bound', title: t.bound(), cell: (row) => <Refs refs={row.bound} /> },
            { id: 'age', title: t.age(), numeric: true, cell: (row) => duration(row.age) },
            { id: 'commands', title: t.commands(), numeric: true, cell: (row) => count_text(row.commands) },
            { id: 'subscriptions', title: t.subscriptions(), numeric: true, cell: (row) => count_text(row.subscriptions) },
            { id: 'waiting', title: t.waiting(), numeric: true, cell: (row) => count_text(row.waiting) },
          ]}
        />
      )}
    </section>
  );
}

function Refs({ refs }: { refs: readonly string[] }) {
  if (refs.length === 0) return <span class="health-soft">{t.nothing_bound()}</span>;
  return <span class="health-refs">{refs.map((ref) => <code key={ref}>{ref}</code>)}</span>;
}

export function Limits() {
  const { metrics } = useConsole();
  const scrape = metrics.latest.value;
  if (!scrape) return null;
  const rows = limits_in(scrape, metrics.history.at(0));
  return (
    <section class="health-part">
      <h3>{t.limits()}</h3>
      {rows.length === 0 ? (
        <p class="health-soft">{t.limits_unknown()}</p>
      ) : (
        <Table<LimitRow>
          label={t.limits()}
          rows={rows}
          key_of={(row) => row.name}
          columns={[
            { id: 'name', title: t.limit(), cell: (row) => t.limit_name(row.name) },
            { id: 'now', title: t.now(), numeric: true, cell: (row) => (row.now === undefined ? t.none() : count_text(row.now)) },
            { id: 'most', title: t.most(), numeric: true, cell: (row) => count_text(row.most) },
            { id: 'reached', title: t.reached(), cell: (row) => <Reached row={row} /> },
          ]}
        />
      )}
    </section>
  );
}

function Reached({ row }: { row: LimitRow }) {
  if (row.reached === 0) return <span class="health-soft">{t.never()}</span>;
  return (
    <>
      {t.times(row.reached)} {row.lately > 0 && <Badge tone="bad">{t.lately(row.lately)}</Badge>}
    </>
  );
}

export function Troubles() {
  const { metrics } = useConsole();
  const scrape = metrics.latest.value;
  if (!scrape) return null;
  return (
    <section class="health-part">
      <h3>{t.troubles()}</h3>
      <Table<TroubleRow>
        label={t.troubles()}
        rows={troubles_in(scrape, metrics.history.at(0))}
        key_of={(row) => `${row.name} ${row.detail}`}
        empty={<p class="health-soft">{t.no_troubles()}</p>}
        columns={[
          { id: 'what', title: t.what(), cell: (row) => t.trouble_name(row.name) },
          { id: 'detail', title: t.detail(), cell: (row) => row.detail !== '' && <code>{row.detail}</code> },
          { id: 'count', title: t.count(), numeric: true, cell: (row) => count_text(row.count) },
          { id: 'lately', title: t.in_minutes(), numeric: true, cell: (row) => (row.lately > 0 ? <strong>{count_text(row.lately)}</strong> : '0') },
        ]}
      />
    </section>
  );
}
