// Tables of sessions, limits and the gateway's error counters.
import { useConsole } from '../context';
import { count_text, duration } from '../i18n/i18n';
import { Badge, Table } from '../ui';
import { type LimitRow, limits_in, type SessionRow, sessions_in, type TroubleRow, troubles_in } from './counters';
import * as texts from './texts';

export function Sessions() {
  const { metrics, bindings, link } = useConsole();
  const scrape = metrics.latest.value;
  const mine = bindings.mine.value;
  const rows = scrape ? sessions_in(scrape, mine, link.session_since) : [];
  return (
    <section class="health-part">
      <h3>{texts.sessions()}</h3>
      {!scrape ? (
        <p>{texts.no_metrics()}</p>
      ) : rows.length === 0 ? (
        <p>
          {texts.sessions_without_details(count_text(scrape.value('rois_sessions') ?? 0))} <Refs refs={[...mine].sort()} />
        </p>
      ) : (
        <Table<SessionRow>
          label={texts.sessions()}
          rows={rows}
          key_of={(row) => row.number}
          columns={[
            {
              id: 'number',
              title: texts.session(),
              cell: (row) => (
                <>
                  {row.number} {row.is_mine && <Badge tone="good">{texts.mine()}</Badge>}
                </>
              ),
            },
            { id: 'bound', title: texts.bound(), cell: (row) => <Refs refs={row.bound} /> },
            { id: 'age', title: texts.age(), numeric: true, cell: (row) => duration(row.age) },
            { id: 'commands', title: texts.commands(), numeric: true, cell: (row) => count_text(row.commands) },
            { id: 'subscriptions', title: texts.subscriptions(), numeric: true, cell: (row) => count_text(row.subscriptions) },
            { id: 'waiting', title: texts.waiting(), numeric: true, cell: (row) => count_text(row.waiting) },
          ]}
        />
      )}
    </section>
  );
}

function Refs({ refs }: { refs: readonly string[] }) {
  if (refs.length === 0) return <span class="health-soft">{texts.nothing_bound()}</span>;
  return <span class="health-refs">{refs.map((ref) => <code key={ref}>{ref}</code>)}</span>;
}

export function Limits() {
  const { metrics } = useConsole();
  const scrape = metrics.latest.value;
  if (!scrape) return null;
  const rows = limits_in(scrape, metrics.history.at(0));
  return (
    <section class="health-part">
      <h3>{texts.limits()}</h3>
      {rows.length === 0 ? (
        <p class="health-soft">{texts.limits_unknown()}</p>
      ) : (
        <Table<LimitRow>
          label={texts.limits()}
          rows={rows}
          key_of={(row) => row.name}
          columns={[
            { id: 'name', title: texts.limit(), cell: (row) => texts.limit_name(row.name) },
            { id: 'now', title: texts.now(), numeric: true, cell: (row) => (row.now === undefined ? texts.none() : count_text(row.now)) },
            { id: 'most', title: texts.most(), numeric: true, cell: (row) => count_text(row.most) },
            { id: 'reached', title: texts.reached(), cell: (row) => <Reached row={row} /> },
          ]}
        />
      )}
    </section>
  );
}

function Reached({ row }: { row: LimitRow }) {
  if (row.reached === 0) return <span class="health-soft">{texts.never()}</span>;
  return (
    <>
      {texts.times(row.reached)} {row.lately > 0 && <Badge tone="bad">{texts.lately(row.lately)}</Badge>}
    </>
  );
}

export function Troubles() {
  const { metrics } = useConsole();
  const scrape = metrics.latest.value;
  if (!scrape) return null;
  return (
    <section class="health-part">
      <h3>{texts.troubles()}</h3>
      <Table<TroubleRow>
        label={texts.troubles()}
        rows={troubles_in(scrape, metrics.history.at(0))}
        key_of={(row) => `${row.name} ${row.detail}`}
        empty={<p class="health-soft">{texts.no_troubles()}</p>}
        columns={[
          { id: 'what', title: texts.what(), cell: (row) => texts.trouble_name(row.name) },
          { id: 'detail', title: texts.detail(), cell: (row) => row.detail !== '' && <code>{row.detail}</code> },
          { id: 'count', title: texts.count(), numeric: true, cell: (row) => count_text(row.count) },
          {
            id: 'lately',
            title: texts.in_minutes(),
            numeric: true,
            cell: (row) => (row.lately > 0 ? <strong>{count_text(row.lately)}</strong> : '0'),
          },
        ]}
      />
    </section>
  );
}
