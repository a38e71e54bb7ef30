// What stands on the time line, each by itself.
import type { CommandEntry } from '../state/commands_state';
import type { ErrorEntry, EventEntry, GapEntry } from '../state/events_state';
import type { Span } from '../state/history';
import type { Tone } from '../ui/states';
import { tone_of } from '../ui/states';

/** What happened at one time. */
export type Mark = { kind: 'event'; entry: EventEntry } | { kind: 'error'; entry: ErrorEntry } | { kind: 'gap'; entry: GapEntry };

/** What took its time, or happened; several marks when they are too dense to be told apart. */
export type Thing = { kind: 'span'; span: Span } | { kind: 'command'; entry: CommandEntry } | { kind: 'marks'; marks: Mark[] };

/** The same for the same thing, in whatever lane. */
export function key_of(thing: Thing): string {
  if (thing.kind === 'span') return `span ${thing.span.number}`;
  if (thing.kind === 'command') return `command ${thing.entry.id} ${thing.entry.sequence.number}`;
  return `marks ${mark_key(thing.marks[0]!)}`;
}

export function mark_key(mark: Mark): string {
  return mark.kind === 'gap' ? `gap ${mark.entry.at}` : `${mark.kind} ${mark.entry.number}`;
}

export function mark_ref(mark: Mark): string {
  if (mark.kind === 'event') return mark.entry.event.component_ref.code;
  return mark.kind === 'error' ? (mark.entry.error.component_ref?.code ?? '') : '';
}

/** The worst that there is among them. */
export function marks_tone(marks: readonly Mark[]): Tone {
  if (marks.some((one) => one.kind === 'error')) return 'bad';
  return marks.some((one) => one.kind === 'gap') ? 'warning' : 'busy';
}

export function span_tone({ kind, value }: Span): Tone {
  if (kind === 'holder') return value === 'me' ? 'good' : 'calm';
  return kind === 'link' && value === 'lost' ? 'bad' : tone_of(value);
}

/** When it began to run, as far as is known: it may have ended before anybody looked. */
export function began_at({ sent_at, started_at, ended_at }: CommandEntry): number | undefined {
  return started_at ?? (ended_at === undefined ? undefined : sent_at);
}
