// History for the time line: each component's status and owner, and the state of the link.
import { effect, type ReadonlySignal } from '@preact/signals';

import type { Environment, Stop } from './base/environment';
import { Pulse } from './base/pulse';
import { Ring } from './base/ring';
import type { MetricsState } from './engine/metrics_state';
import type { StatusState } from './engine/status_state';
import type { Bindings } from './session/bindings';
import type { LinkState } from './session/link_state';

/** `status` and `holder` (`me` or a session number) of a component; `link`: its phase. */
export type SpanKind = 'status' | 'holder' | 'link';

/** A period in which a value did not change. */
export interface Span {
  number: number; // in order of their begin
  kind: SpanKind;
  ref: string; // the component; empty for the link
  value: string;
  from: number; // first seen, ms since 1970
  to: number; // last seen
  note: string; // in English: the reason; usually empty
}

interface Sources {
  link: LinkState;
  status: StatusState;
  metrics: MetricsState;
  bindings: Bindings;
  now: ReadonlySignal<number>;
}

const most_spans = 20_000;
/** After a longer time without an observation, the value in between is unknown. A status query may take some seconds to fail. */
export const longest_blink = 15_000; // ms
const stale_after = 5000; // ms without metrics, after which other sessions' bindings are unknown

export class History {
  /** Ended spans, in order of their end. */
  readonly past: Ring<Span>;
  /** Current spans, at most one for each kind and component. */
  readonly present = new Map<string, Span>();
  /** Beats when a span begins or ends. */
  readonly pulse: Pulse;
  private readonly freed = new Map<string, number>(); // time of release
  private next = 0;

  constructor(
    private readonly environment: Environment,
    private readonly sources: Sources,
    most = most_spans,
  ) {
    this.past = new Ring(most);
    this.pulse = new Pulse(environment);
  }

  /** Records until the returned function is called. Watches the state that it needs. */
  record(): Stop {
    const { link, status, metrics, bindings, now } = this.sources;
    const is_open = () => /^(open|resumed)$/.test(link.view.peek().phase);
    const stops = [
      status.poll.watch(),
      metrics.poll.watch(),
      effect(() => {
        const { phase, since, reason } = link.view.value;
        this.see('link', '', phase, since, reason);
        if (phase !== 'open' && phase !== 'resumed') this.break_off();
      }),
      effect(() => {
        const all = status.all.value;
        if (!is_open()) return;
        for (const [ref, { status: value, at, trouble }] of all) this.see('status', ref, value, at, trouble ?? '');
        this.end_others('status', (ref) => all.has(ref));
      }),
      effect(() => {
        const at = now.value;
        const mine = bindings.mine.value;
        const all = metrics.bound.value;
        this.see('link', '', link.view.peek().phase, at, link.view.peek().reason);
        if (!is_open()) return;
        for (const ref of mine) this.see('holder', ref, 'me', this.environment.now());
        const reported_at = metrics.latest.peek()?.at ?? 0;
        const is_fresh = at - reported_at < stale_after;
        const others = is_fresh ? [...all].filter(([ref]) => !mine.has(ref) && !this.was_mine(ref, reported_at)) : [];
        for (const [ref, session] of others) this.see('holder', ref, session, this.environment.now());
        this.end_others('holder', (ref, value) => mine.has(ref) || (value !== 'me' && (!is_fresh || all.get(ref) === value)));
      }),
    ];
    return () => {
      for (const stop of stops) stop();
      this.break_off();
    };
  }

  /** Adds the spans of this page before its reload. */
  recall(spans: readonly Span[]): void {
    for (const span of spans) this.past.push({ ...span, number: this.next++ });
    this.pulse.touch();
  }

  // Metrics from before a release still name this console's session.
  private was_mine(ref: string, reported_at: number): boolean {
    if (this.present.get(`holder ${ref}`)?.value === 'me') this.freed.set(ref, this.environment.now());
    if ((this.freed.get(ref) ?? 0) >= reported_at) return true;
    this.freed.delete(ref);
    return false;
  }

  private see(kind: SpanKind, ref: string, value: string, at: number, note = ''): void {
    const key = `${kind} ${ref}`;
    const before = this.present.get(key);
    if (before && at < before.to) return; // already recorded
    const goes_on = before !== undefined && (kind === 'link' || at - before.to <= longest_blink);
    if (before && goes_on) {
      before.to = at; // approximately: it changed between two observations
      if (before.value === value && (kind === 'link' || before.note === note)) return; // the note of the link stays the reason of its loss
    }
    if (before) this.past.push(before);
    this.present.set(key, { number: this.next++, kind, ref, value, from: at, to: at, note });
    this.pulse.touch();
  }

  private end_others(kind: SpanKind, is_there: (ref: string, value: string) => boolean): void {
    for (const [key, span] of this.present) {
      if (span.kind !== kind || is_there(span.ref, span.value)) continue;
      this.present.delete(key);
      this.past.push(span);
      this.pulse.touch();
    }
  }

  // The values are unknown from now on: ends the current spans.
  private break_off(): void {
    for (const kind of ['status', 'holder'] as const) this.end_others(kind, () => false);
  }
}
