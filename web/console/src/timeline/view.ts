// The shown time range and its changes.
import { signal } from '@preact/signals';

import type { Console } from '../state/console';
import { live_sources, oldest_of, type Sources, stopped_sources } from './sources';

/** ms since 1970. */
export interface Range {
  from: number;
  to: number;
}

/** Length and end of the shown range; without `end`, until now. */
export interface Stretch {
  span: number; // ms
  end?: number; // ms since 1970
  /** From the oldest known time. */
  is_all?: true;
}

const usual_span = 60_000; // ms
const least_span = 50;
const always_allowed = 15 * 60_000; // even if less is known
const most_undone = 30;

/** Limited to the known time, or `ahead` beyond now; not shorter than `least_span`. */
export function within(stretch: Stretch, oldest: number, now: number, ahead = 0): Stretch {
  const span = Math.min(Math.max(stretch.span, least_span), Math.max(always_allowed, (now - oldest) * 1.1));
  if (stretch.end === undefined) return { span };
  return { span, end: Math.min(now + ahead * span, Math.max(stretch.end, Math.min(oldest + span * 0.25, now))) };
}

/** Zooms around `at`. A live range stays live. */
export function zoomed(stretch: Stretch, factor: number, at: number): Stretch {
  const span = Math.max(least_span, stretch.span * factor);
  return stretch.end === undefined ? { span } : { span, end: at + ((stretch.end - at) * span) / stretch.span };
}

/** View state of the time line, kept while another panel is shown. */
export class TimeView {
  readonly stretch = signal<Stretch>({ span: usual_span });
  readonly hides_quiet = signal(false);
  readonly with_own = signal(false);
  /** The time at which a live range is held, so that things stay under the pointer. */
  readonly held = signal<number | undefined>(undefined);
  private readonly stopped = signal<Sources | undefined>(undefined);
  private readonly before: Stretch[] = [];

  constructor(private readonly console: Console) {}

  /** Whether the range follows the time. */
  get is_live(): boolean {
    return this.stretch.value.end === undefined;
  }
  get sources(): Sources {
    return this.stopped.value ?? live_sources(this.console);
  }
  range(at: number, sources?: Sources): Range {
    const { span, is_all, end = this.held.value ?? at } = this.stretch.value;
    return { from: end - (is_all ? whole_of(sources ?? this.sources, end) : span), to: end };
  }

  go_live(): void {
    this.stopped.value = undefined;
    this.held.value = undefined;
    this.stretch.value = { span: Math.min(this.stretch.value.span, always_allowed) };
  }

  /** Pauses at the present time. */
  pause(): void {
    if (!this.is_live) return;
    const sources = stopped_sources(this.console);
    const { from, to } = this.range(sources.at, sources);
    this.stopped.value = sources;
    this.stretch.value = { span: to - from, end: to };
  }

  /** `at`: the time that keeps its place. */
  zoom(factor: number, at?: number): void {
    const { from, to } = this.range(this.sources.at);
    // The time under the pointer keeps its place.
    this.put(zoomed({ ...this.stretch.value, span: to - from }, factor, at ?? this.middle), 0.5);
  }
  move(ms: number): void {
    this.pause();
    const { span, end = 0 } = this.stretch.value;
    this.put({ span, end: end + ms });
  }
  show(from: number, to: number): void {
    this.remember();
    this.pause();
    this.put({ span: to - from, end: to });
  }
  show_all(): void {
    const { sources } = this;
    const span = whole_of(sources, sources.at);
    this.remember();
    if (this.is_live) this.stretch.value = { span, is_all: true };
    else this.put({ span, end: sources.at });
  }
  go_to_oldest(): void {
    this.pause();
    const { span } = this.stretch.value;
    this.put({ span, end: oldest_of(this.sources) + span * 0.98 });
  }
  set_span(span: number): void {
    const { end } = this.stretch.value;
    this.put(end === undefined ? { span } : { span, end: this.middle + span / 2 });
  }

  /** Returns to the range before the last selection. */
  undo(): void {
    const before = this.before.pop();
    if (!before) return;
    if (before.end === undefined) this.go_live();
    if (before.is_all) this.stretch.value = before;
    else this.put(before);
  }
  get can_undo(): boolean {
    return this.before.length > 0;
  }

  private get middle(): number {
    const { from, to } = this.range(this.sources.at);
    return (from + to) / 2;
  }
  private remember(): void {
    this.before.push(this.stretch.value);
    if (this.before.length > most_undone) this.before.shift();
  }
  private put(stretch: Stretch, ahead = 0): void {
    const { sources } = this;
    this.stretch.value = within(stretch, oldest_of(sources), sources.at, ahead);
  }
}

// ms; slightly more than the known time.
function whole_of(sources: Sources, end: number): number {
  return Math.max(least_span, (end - oldest_of(sources)) * 1.02);
}

const kept = new WeakMap<Console, TimeView>();

export function view_of(console: Console): TimeView {
  const view = kept.get(console) ?? new TimeView(console);
  kept.set(console, view);
  return view;
}
