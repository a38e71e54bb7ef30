// The things on the time line.
import type { Span } from '../state/history';
import type { CommandEntry } from '../state/session/commands_state';
import type { LoggedDocument } from '../state/session/document_log';
import type { ErrorEntry, EventEntry, GapEntry, SwitchEntry } from '../state/session/events_state';
import { type Tone, tone_of } from '../ui';

/** The time at which a command failed. */
export interface Failure {
  at: number;
  command: CommandEntry;
}

/** An event at one time. `refused`: a refusal. */
export type Mark =
  | { kind: 'event'; entry: EventEntry }
  | { kind: 'error'; entry: ErrorEntry }
  | { kind: 'switched'; entry: SwitchEntry }
  | { kind: 'gap'; entry: GapEntry }
  | { kind: 'refused'; entry: LoggedDocument }
  | { kind: 'failed'; entry: Failure };

/** A span, a command, or marks that are too dense to separate. */
export type Thing = { kind: 'span'; span: Span } | { kind: 'command'; entry: CommandEntry } | { kind: 'marks'; marks: Mark[] };

/** The same for one thing in any lane. */
export function key_of(thing: Thing): string {
  if (thing.kind === 'span') return `span ${thing.span.number}`;
  if (thing.kind === 'command') return `command ${thing.entry.id} ${thing.entry.sequence.number}`;
  return `marks ${mark_key(thing.marks[0]!)}`;
}

export function mark_key(mark: Mark): string {
  if (mark.kind === 'failed') return `failed ${mark.entry.command.id} ${mark.entry.command.sequence.number}`;
  return mark.kind === 'gap' ? `gap ${mark.entry.at}` : `${mark.kind} ${mark.entry.number}`;
}

export function mark_ref(mark: Mark): string {
  if (mark.kind === 'event') return mark.entry.event.component_ref.code;
  if (mark.kind === 'refused') return mark.entry.request?.component ?? '';
  if (mark.kind === 'failed') return mark.entry.command.component;
  if (mark.kind === 'switched') return mark.entry.switched.component_ref.code;
  return mark.kind === 'error' ? (mark.entry.error.component_ref?.code ?? '') : '';
}

/** The worst tone of the marks. */
export function marks_tone(marks: readonly Mark[]): Tone {
  if (marks.some((one) => is_bad(one))) return 'bad';
  return marks.some((one) => one.kind === 'gap' || one.kind === 'switched') ? 'warning' : 'busy';
}

function is_bad({ kind }: Mark): boolean {
  return kind === 'error' || kind === 'refused' || kind === 'failed';
}

export function has_failed({ state, ended_at }: CommandEntry): boolean {
  return ended_at !== undefined && tone_of(state) === 'bad';
}

/** The thing to open: for the mark of a failed command, the command. */
export function opened_by(thing: Thing): Thing {
  const [mark] = thing.kind === 'marks' ? thing.marks : [];
  return thing.kind === 'marks' && thing.marks.length === 1 && mark?.kind === 'failed'
    ? { kind: 'command', entry: mark.entry.command }
    : thing;
}

export function span_tone({ kind, value }: Span): Tone {
  if (kind === 'holder') return value === 'me' ? 'good' : 'calm';
  return kind === 'link' && value === 'lost' ? 'bad' : tone_of(value);
}

/** When it began to run, as far as known: it may have ended before a check. */
export function began_at({ sent_at, started_at, ended_at }: CommandEntry): number | undefined {
  return started_at ?? (ended_at === undefined ? undefined : sent_at);
}
