// The data to draw, live or as of a pause.
import type { Ring } from '../state/base/ring';
import type { Console } from '../state/console';
import { longest_blink, type Span } from '../state/history';
import type { CommandEntry } from '../state/session/commands_state';
import type { LoggedDocument } from '../state/session/document_log';
import type { ErrorEntry, EventEntry, GapEntry, SwitchEntry } from '../state/session/events_state';

/** Common interface of a ring and its copy. */
export interface Rows<T> extends Iterable<T> {
  readonly size: number;
  at(index: number): T | undefined;
}

export interface Sources {
  at: number; // now, or the time of the pause; ms since 1970
  refs: readonly string[]; // of components, in listed order
  commands: Rows<CommandEntry>;
  events: Rows<EventEntry>;
  own_events: Rows<EventEntry>;
  errors: Rows<ErrorEntry>;
  switches: Rows<SwitchEntry>;
  gaps: Rows<GapEntry>;
  refused: Rows<LoggedDocument>; // refusals
  past: Rows<Span>;
  present: readonly Span[];
}

export function live_sources(console: Console): Sources {
  const { commands, events, history, traffic } = console;
  const rings = {
    commands: commands.all,
    events: events.events,
    own_events: events.own_events,
    errors: events.errors,
    switches: events.switches,
    gaps: events.gaps,
    refused: traffic.refused,
    past: history.past,
  };
  return { at: console.environment.now(), refs: refs_of(console), ...rings, present: [...history.present.values()] };
}

/** A copy for a pause, as bounded as its source. */
export function stopped_sources(console: Console): Sources {
  const { commands, events, own_events, errors, switches, gaps, refused, past, present, ...rest } = live_sources(console);
  return {
    ...rest,
    commands: copy(commands),
    events: copy(events),
    own_events: copy(own_events),
    errors: copy(errors),
    switches: copy(switches),
    gaps: copy(gaps),
    refused: copy(refused),
    past: copy(past),
    present: present.map((one) => ({ ...one })),
  };
}

function copy<T>(rows: Rows<T>): Rows<T> {
  const list = (rows as Ring<T>).list();
  return { size: list.length, at: (index) => list.at(index), [Symbol.iterator]: () => list.values() };
}

/** The drawn end of a span: a current one lasts until now, unless it has not been observed for long. */
export function end_of(span: Span, is_present: boolean, at: number): number {
  return is_present && at - span.to <= longest_blink ? at : span.to;
}

/** The oldest known time. */
export function oldest_of(sources: Sources): number {
  let oldest = sources.at;
  for (const from of [
    sources.commands.at(0)?.sent_at,
    sources.events.at(0)?.at,
    sources.errors.at(0)?.at,
    sources.past.at(0)?.from,
    ...sources.present.map((one) => one.from),
  ])
    if (from !== undefined && from < oldest) oldest = from;
  return oldest;
}

/** The index of the first entry at or after a time; entries are sorted. */
export function first_since<T>(rows: Rows<T>, time_of: (one: T) => number, from: number): number {
  let [low, high] = [0, rows.size];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (time_of(rows.at(middle)!) < from) low = middle + 1;
    else high = middle;
  }
  return low;
}

// Components of the profile, then earlier ones.
function refs_of({ profile, history }: Console): string[] {
  const refs = new Set(profile.components.value.map((one) => one.ref));
  for (const span of history.past) if (span.ref !== '') refs.add(span.ref);
  return [...refs];
}
