// Stores what the time line shows across a reload of the page. Documents are too large for that.
import { Results } from 'rois-client';

import type { Console } from './console';
import type { Span } from './history';
import type { CommandEntry } from './session/commands_state';
import type { LoggedDocument } from './session/document_log';
import type { EarlierEvents, ErrorEntry, EventEntry } from './session/events_state';

/** Rows of each kind to store, the newest: about 1 MB in all. If the browser refuses, the next smaller number is tried. */
const offers = [1000, 200, 40];
const no_document = -1; // the number of a document that is not stored

interface Kept extends EarlierEvents {
  spans: Span[];
  commands: CommandEntry[];
  refused: LoggedDocument[];
}

/** `remember` returns whether the browser has stored the text. */
export function keep(console: Console, remember: (text: string) => boolean): void {
  offers.some((most) => remember(kept_text(console, most)));
}

function kept_text({ history, commands, events, traffic }: Console, most: number): string {
  const newest = <T>(rows: Iterable<T>) => [...rows].slice(-most);
  const kept: Kept = {
    spans: newest([...history.past, ...history.present.values()]),
    commands: newest(commands.all),
    events: newest(events.events),
    own_events: newest(events.own_events),
    errors: newest(events.errors),
    switches: newest(events.switches),
    gaps: newest(events.gaps),
    refused: newest(traffic.refused).map(in_short),
  };
  // Commands and their sequence refer to each other.
  return JSON.stringify(kept, (key, value: unknown) => (key === 'units' || (key === 'commands' && value !== kept.commands) ? [] : value));
}

/** Adds what this page stored before its reload. Invalid data is ignored. */
export function restore(console: Console, text: string | undefined): void {
  if (text === undefined) return;
  try {
    const { spans, commands, events, own_events, errors, switches, gaps, refused } = JSON.parse(text) as Kept;
    const details = <T extends EventEntry | ErrorEntry>(entry: T): T => ({ ...entry, document: no_document, details: with_results(entry) });
    console.history.recall(spans);
    console.commands.recall(commands.map((one) => ({ ...one, ...(one.results && { results: results_of(one.results) }) })));
    console.events.recall({
      events: events.map(revived).map(details),
      own_events: own_events.map(revived).map(details),
      errors: errors.map(details),
      switches: switches.map((one) => ({ ...one, document: no_document })),
      gaps,
    });
    console.traffic.recall(refused.map((one, i) => ({ ...one, number: no_document - i })));
  } catch {
    // stored by another version of the page
  }
}

// A document reduced to what the time line and the error log show.
function in_short({ at, direction, kind, name, return_code, text, component, request, is_own }: LoggedDocument): LoggedDocument {
  const reason = /<(?:[\w.-]+:)?reason>([^<]*)</.exec(text)?.[1] ?? '';
  const about = request?.component ?? component;
  const short = { number: no_document, at, direction, kind, is_own, ...(about !== undefined && { component: about }) };
  return {
    ...short,
    name,
    text: `<refused><reason>${reason}</reason></refused>`,
    ...(return_code !== undefined && { return_code }),
    ...(request && { request: { ...short, name: request.name, text: '' } }),
  };
}

function revived(entry: EventEntry): EventEntry {
  const { event } = entry;
  return { ...entry, event: { ...event, expire: new Date(event.expire), results: results_of(event.results) } };
}

function results_of({ parameters, located }: Results): Results {
  return new Results(parameters, located);
}

function with_results({ details }: EventEntry | ErrorEntry): EventEntry['details'] {
  if (details.state === 'there') return { state: 'there', results: results_of(details.results) };
  return { state: 'gone', reason: '' };
}
