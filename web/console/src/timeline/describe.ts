// Descriptions of things on the time line, for tooltips, tables and screen readers.
import { parse_xml } from 'rois-client';

import { why } from '../forms/why';
import { clock_time, duration } from '../i18n/i18n';
import * as shell from '../shell/texts';
import type { Console } from '../state/console';
import type { Span } from '../state/history';
import type { CommandEntry } from '../state/session/commands_state';
import type { EventEntry } from '../state/session/events_state';
import type { Phase } from '../state/session/link_state';
import * as texts from './texts';
import { began_at, has_failed, type Mark, mark_ref, opened_by, type Thing } from './things';

export interface Description {
  at: number; // for sorting
  kind: string; // in the user's language
  title: string;
  component: string;
  /** A name of the specification: status, state, error type; may be empty. */
  state: string;
  /** Additional names and values. */
  facts: [name: string, value: string][];
}

/** The link's state as in the header. */
export function phase_text(phase: string): string {
  return shell.phase(phase as Phase);
}

/** `at`: the end of the known time. */
export function describe(thing: Thing, at: number): Description {
  if (thing.kind === 'span') return of_span(thing.span, at);
  if (thing.kind === 'command') return of_command(thing.entry, at);
  return thing.marks.length === 1 ? of_mark(thing.marks[0]!) : of_many(thing.marks);
}

/** Includes why it failed, as far as known. */
export function describe_whole(console: Console, thing: Thing, at: number): Description {
  const described = describe(thing, at);
  const opened = opened_by(thing);
  if (opened.kind !== 'command' || !has_failed(opened.entry)) return described;
  const reasons = why(console, opened.entry);
  return reasons.length === 0
    ? described
    : {
        ...described,
        facts: [
          ...described.facts.filter(([name]) => name !== texts.reason()),
          [texts.reason(), reasons.join(' ').replace(/^reason: /, '')],
        ],
      };
}

/** In one line. */
export function sentence({ kind, title, component, state, facts }: Description): string {
  return [
    kind,
    title,
    component === title ? '' : component,
    state === title ? '' : state,
    ...facts.map(([name, value]) => `${name} ${value}`),
  ]
    .filter((one) => one !== '')
    .join(', ');
}

function of_span({ kind, ref, value, from, to, note }: Span, at: number): Description {
  const goes_on = at - to < 2000;
  const times: Description['facts'] = [
    [texts.from(), clock_time(from)],
    [texts.to(), goes_on ? texts.goes_on() : clock_time(to)],
    [texts.lasted(), duration((goes_on ? at : to) - from)],
  ];
  if (note !== '') times.push([texts.reason(), note]);
  if (kind === 'holder')
    return {
      at: from,
      kind: texts.holder(),
      title: value === 'me' ? texts.by_me() : texts.by_session(value),
      component: ref,
      state: '',
      facts: times,
    };
  if (kind === 'link') return { at: from, kind: texts.link(), title: phase_text(value), component: '', state: '', facts: times };
  return { at: from, kind: texts.status(), title: value, component: ref, state: value, facts: times };
}

function of_command(entry: CommandEntry, at: number): Description {
  const began = began_at(entry);
  const facts: Description['facts'] = [
    [texts.sent(), clock_time(entry.sent_at)],
    [
      texts.began(),
      entry.started_at !== undefined ? clock_time(entry.started_at) : entry.ended_at === undefined ? texts.not_yet() : texts.not_seen(),
    ],
    [texts.ended(), entry.ended_at === undefined ? texts.not_yet() : clock_time(entry.ended_at)],
  ];
  if (entry.started_at !== undefined) facts.push([texts.waited(), duration(entry.started_at - entry.sent_at)]);
  if (began !== undefined) facts.push([texts.ran(), duration((entry.ended_at ?? at) - began)]);
  const why = entry.state === 'OK' ? undefined : entry.results?.text('reason');
  if (why) facts.push([texts.reason(), why]);
  return { at: entry.sent_at, kind: texts.command(), title: entry.command_type, component: entry.component, state: entry.state, facts };
}

const most_located = 5;

export function of_mark(mark: Mark): Description {
  if (mark.kind === 'failed') return of_command(mark.entry.command, mark.entry.at);
  const { at } = mark.entry;
  const facts: Description['facts'] = [[texts.when(), clock_time(at)]];
  if (mark.kind === 'gap') {
    const { gap } = mark.entry;
    return {
      at,
      kind: texts.gap(),
      title: gap.reason === 'session' ? texts.gap_session() : texts.gap_lost(gap.count),
      component: '',
      state: '',
      facts,
    };
  }
  const component = mark_ref(mark);
  if (mark.kind === 'refused')
    return {
      at,
      kind: texts.refused(),
      title: mark.entry.request?.name ?? mark.entry.name,
      component,
      state: mark.entry.return_code ?? '',
      facts: [...facts, [texts.reason(), reason_in(mark.entry.text)]],
    };
  if (mark.kind === 'switched') {
    const { from, to, reason } = mark.entry.switched;
    const title = `${from} → ${to}`.trim();
    return { at, kind: texts.switched(), title, component, state: '', facts: [...facts, [texts.reason(), reason]] };
  }
  if (mark.kind === 'error') return { at, kind: texts.error(), title: mark.entry.error.error_type, component, state: '', facts };
  return { at, kind: texts.event(), title: mark.entry.event.event_type, component, state: '', facts: [...facts, ...located(mark.entry)] };
}

/** Positions reported by an event. */
export function located({ event: { results } }: EventEntry): Description['facts'] {
  return results.located
    .slice(0, most_located)
    .map(({ ref, position: [x, y] }) => [ref, `${(x / 1000).toFixed(2)}, ${(y / 1000).toFixed(2)} m`]);
}

function of_many(marks: readonly Mark[]): Description {
  const [first, last] = [marks[0]!.entry.at, marks.at(-1)!.entry.at];
  const counts = new Map<string, number>();
  for (const mark of marks) {
    const { title } = of_mark(mark);
    counts.set(title, (counts.get(title) ?? 0) + 1);
  }
  const refs = new Set(marks.map(mark_ref));
  const facts: Description['facts'] = [[texts.when(), `${clock_time(first)} – ${clock_time(last)}`]];
  for (const [title, n] of [...counts].sort((a, b) => b[1] - a[1]).slice(0, 5)) facts.push([title, `× ${n}`]);
  return { at: first, kind: '', title: texts.many(marks.length), component: refs.size === 1 ? [...refs][0]! : '', state: '', facts };
}

function reason_in(text: string): string {
  return parse_xml(text).text_of('reason');
}
