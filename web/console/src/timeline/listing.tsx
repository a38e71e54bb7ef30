// The time line as a table, for screen readers and for reading values.
import { useConsole } from '../context';
import { clock_time, duration } from '../i18n/i18n';
import { EmptyState, StatusBadge, Table } from '../ui';
import { describe, type Description, located, sentence } from './describe';
import { lay_out } from './layout';
import { key_of, type Thing } from './things';
import * as texts from './texts';
import type { TimeView } from './view';

const most_rows = 200;

interface Row extends Description {
  thing: Thing;
  key: string;
  lasted: string;
  where: string; // positions of an event
}

export function Listing({ view, open }: { view: TimeView; open: (thing: Thing) => void }) {
  const console = useConsole();
  if (view.is_live) void console.now.value; // once a second
  const { at } = view.sources;
  const { rows, count } = rows_of(view, at);
  if (count === 0) return <EmptyState icon="timeline" title={texts.nothing()} />;
  return (
    <div class="timeline-listing">
      {count > rows.length && <p class="timeline-listing-note">{texts.shown_of(rows.length, count)}</p>}
      <Table
        label={texts.label()}
        rows={rows}
        key_of={(row) => row.key}
        columns={[
          {
            id: 'when',
            title: texts.when(),
            cell: ({ at }) => (
              <>
                {clock_time(at, false)}
                <span class="timeline-ms">{clock_time(at).slice(-4)}</span>
              </>
            ),
          },
          {
            id: 'what',
            title: texts.what(),
            cell: (row) => (
              <button type="button" class="timeline-row" aria-label={texts.open(sentence(row))} onClick={() => open(row.thing)}>
                <span class="timeline-kind">{row.kind}</span> {row.title}{row.where && ` ${row.where}`}
              </button>
            ),
          },
          { id: 'component', title: texts.component(), cell: (row) => row.component },
          { id: 'state', title: texts.state(), cell: (row) => row.state !== '' && <StatusBadge status={row.state} /> },
          { id: 'lasted', title: texts.lasted(), cell: (row) => row.lasted, numeric: true },
        ]}
      />
    </div>
  );
}

// Each thing once, marks separately, newest first.
function rows_of(view: TimeView, at: number): { rows: Row[]; count: number } {
  const { placed } = lay_out(view.sources, view.range(at), {
    width: 1000,
    hides_quiet: view.hides_quiet.value,
    with_own: view.with_own.value,
  });
  const things = new Map<string, Thing>();
  for (const { thing } of placed)
    for (const one of thing.kind === 'marks'
      ? thing.marks.filter((mark) => mark.kind !== 'failed').map((mark): Thing => ({ kind: 'marks', marks: [mark] }))
      : [thing])
      things.set(key_of(one), one);
  const newest = [...things.values()].sort((a, b) => time_of_thing(b) - time_of_thing(a)).slice(0, most_rows);
  const rows = newest.map((thing): Row => ({
    ...describe(thing, at),
    thing,
    key: key_of(thing),
    lasted: lasted(thing, at),
    where: where(thing),
  }));
  return { rows, count: things.size };
}

function where(thing: Thing): string {
  const [mark] = thing.kind === 'marks' ? thing.marks : [];
  return mark?.kind === 'event' ? located(mark.entry).map((one) => one.join(' ')).join('; ') : '';
}

function time_of_thing(thing: Thing): number {
  if (thing.kind === 'span') return thing.span.from;
  return thing.kind === 'command' ? thing.entry.sent_at : thing.marks[0]!.entry.at;
}

function lasted(thing: Thing, at: number): string {
  if (thing.kind === 'span') return duration(thing.span.to - thing.span.from);
  return thing.kind === 'command' ? duration((thing.entry.ended_at ?? at) - thing.entry.sent_at) : '';
}
