// Summarizes a document in a few words without parsing it.
import type { LoggedDocument } from '../state/session/document_log';
import { unescaped } from '../ui';

const known = new WeakMap<LoggedDocument, string>();

/** Event: `person-1 1.00, 2.00 m` or `number: 2`; execute: `speech_synthesis start`; refusal: its reason. */
export function summary(document: LoggedDocument): string {
  const before = known.get(document);
  if (before !== undefined) return before;
  const made_summary = made_of(document);
  known.set(document, made_summary);
  return made_summary;
}

/** The root's name; for an event, the event type. */
export function name_of({ name, text }: LoggedDocument): string {
  return (name === 'receive_event' && first_text(text, 'event_type')) || name;
}

/** The component that the document names, also in a condition; empty: none. */
export function component_of({ component, text, kind }: LoggedDocument): string {
  if (component !== undefined || kind !== 'request') return component ?? '';
  return unescaped(/>component_ref<\/[^>]*>\s*<(?:[\w.-]+:)?Literal>([^<]*)</.exec(text)?.[1] ?? '');
}

/** The command id of a `completed`. */
export function command_of({ text }: LoggedDocument): string {
  return first_text(text, 'command_id');
}

export function expire_of({ name, text }: LoggedDocument): number | undefined {
  const time = name === 'receive_event' ? Date.parse(first_text(text, 'expire')) : NaN;
  return Number.isNaN(time) ? undefined : time;
}

function made_of(document: LoggedDocument): string {
  const { name, text, kind } = document;
  const reason = first_text(text, 'reason');
  if (name === 'switched') return `${first_text(text, 'from')} → ${first_text(text, 'to')}: ${reason}`.trim();
  if (reason !== '') return reason;
  switch (name) {
    case 'receive_event':
      return of_event(document);
    case 'receive_error':
      return first_text(text, 'error_type');
    case 'completed':
      return `${first_text(text, 'status')}  ${first_text(text, 'command_id')}`;
    case 'lost':
      return first_text(text, 'count');
    case 'execute':
      return commands(text).join(', ');
    case 'set_parameter':
      return values(text, 'parameter').join('  ');
    case 'query':
      return first_text(text, 'query_type');
    case 'subscribe':
      return first_text(text, 'event_type');
    case 'unsubscribe':
      return first_text(text, 'subscribe_id');
    case 'get_command_result':
      return first_text(text, 'command_id');
    case 'get_event_detail':
      return first_text(text, 'event_id');
    case 'get_error_detail':
      return first_text(text, 'error_id');
    default:
      return kind === 'answer' ? values(text, 'result').join('  ') || references(text) : '';
  }
}

function first_text(text: string, name: string): string {
  return unescaped(new RegExp(`<(?:[\\w.-]+:)?${name}(?:\\s[^>]*)?>([^<]*)<`).exec(text)?.[1] ?? '');
}

const attribute = (name: string) => `(?:[\\w.-]+:)?${name}\\s*=\\s*["']([^"']*)["']`;
const most = 12; // values or commands

function values(text: string, element: string): string[] {
  const each = new RegExp(`<(?:[\\w.-]+:)?${element}\\s[^>]*?${attribute('name')}[^>]*>([^]*?)</(?:[\\w.-]+:)?${element}>`, 'g');
  return [...first_of(text.matchAll(each))].filter(([, name]) => name !== 'timestamp').map(([, name, inside]) => {
    const items = [...inside!.matchAll(/<(?:[\w.-]+:)?value(?:\s[^>]*)?>([^<]*)</g)].map(([, value]) => unescaped(value!));
    return `${name}: ${items.join('; ')}`;
  });
}

// Positions come first and replace the lists of the same values.
function of_event(document: LoggedDocument): string {
  const positions = located(document.text);
  const more = values(document.text, 'result').filter((one) => positions.length === 0 || !/^(\w+_ref|position_data):/.test(one));
  return [...positions, ...more].join('  ');
}

// `person-1 1.00, 2.00 m`
function located(text: string): string[] {
  const each = new RegExp(`<(?:[\\w.-]+:)?located\\s[^>]*?${attribute('ref')}[^>]*>[^]*?<(?:[\\w.-]+:)?position>\\s*(\\S+)\\s+(\\S+)`, 'g');
  return [...first_of(text.matchAll(each))].map(([, ref, x, y]) => `${unescaped(ref!)} ${metres(x)}, ${metres(y)} m`);
}

const metres = (mm: string | undefined) => (Number(mm) / 1000).toFixed(2);

function commands(text: string): string[] {
  const each = new RegExp(`<[^>]*?${attribute('command_type')}[^>]*>\\s*<(?:[\\w.-]+:)?component_ref\\s[^>]*?${attribute('code')}`, 'g');
  return [...first_of(text.matchAll(each))].map(([, type, ref]) => `${ref} ${type}`);
}

function references(text: string): string {
  const each = new RegExp(`<(?:[\\w.-]+:)?component_ref\\s[^>]*?${attribute('code')}`, 'g');
  return [...first_of(text.matchAll(each))].map(([, ref]) => ref).join(', ');
}

function* first_of<T>(all: Iterable<T>): Iterable<T> {
  let n = 0;
  for (const one of all) {
    if (n++ === most) return;
    yield one;
  }
}
