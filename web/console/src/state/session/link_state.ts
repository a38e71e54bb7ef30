// The state of the link as shown to the user.
import { batch, signal } from '@preact/signals';
import { answer_text, type Client, type Gap, type StateChange } from 'rois-client';

import type { Environment } from '../base/environment';

/**
 * - `connecting`: first connection;
 * - `open`: new session; `resumed`: same session after a loss;
 * - `lost`: shown data is stale; retrying;
 * - `refused`: the gateway refuses this console (too many sessions, unknown origin); retrying;
 * - `token`: the gateway requires a token or another one; waiting for the user;
 * - `draining`: the gateway is starting or shutting down; retrying;
 * - `closed`: closed by the user.
 */
export type Phase = 'connecting' | 'open' | 'resumed' | 'lost' | 'refused' | 'token' | 'draining' | 'closed';

export interface LinkView {
  phase: Phase;
  since: number; // ms since 1970
  reason: string; // in English, from the gateway or browser; empty when open
}

/** A gap, shown until the user has acknowledged it. */
export interface MissedNote {
  at: number;
  gap: Gap;
}

/** The result of a plain HTTP request to the gateway. */
type Outlook = { phase: Phase; reason: string } | 'reachable' | 'unreachable';

export class LinkState {
  readonly view = signal<LinkView>({ phase: 'connecting', since: 0, reason: '' });
  readonly missed = signal<MissedNote | undefined>(undefined);
  /** The session's id; empty if there is none. Its holder can act as this console, with the same token if the gateway asks for tokens. */
  readonly session = signal('');
  /** When the session began, in ms since 1970. Resuming does not change it. */
  session_since = 0;
  /** When the last document arrived, in ms since 1970; 0: none yet. Not a signal, because it changes all the time; ages are updated each
      second. */
  received_at = 0;

  constructor(private readonly environment: Environment) {
    this.set_phase('connecting', '');
  }

  get is_open(): boolean {
    const { phase } = this.view.value;
    return phase === 'open' || phase === 'resumed';
  }

  /** Follows a client. Calls `wants_token` if the gateway refuses its token. */
  follow(client: Client, token: string | undefined, wants_token: () => void): () => void {
    this.set_phase('connecting', '');
    let asked = 0;
    let gave_up = false;
    const changed = ({ state, reason }: StateChange) => {
      if (gave_up) return;
      asked += 1;
      const question = asked;
      batch(() => {
        if (client.session !== this.session.value) this.session_since = this.environment.now();
        this.session.value = client.session;
        if (state === 'connecting' || state === 'lost') this.trouble(state, reason);
        else this.set_phase(state, reason);
      });
      if (state !== 'connecting' && state !== 'lost') return;
      void this.outlook(token).then((outlook) => {
        if (question !== asked) return;
        if (outlook === 'unreachable' && this.view.value.phase !== state) this.set_phase(state, reason);
        if (typeof outlook === 'string') return;
        this.set_phase(outlook.phase, outlook.reason);
        if (outlook.phase !== 'token') return;
        gave_up = true; // repeating would have the same result
        wants_token();
      });
    };
    const stops = [
      client.on('state', changed),
      client.on('gap', (gap) => this.note_gap(gap)),
      client.on('document', ({ direction }) => {
        if (direction === 'in') this.received_at = this.environment.now();
      }),
    ];
    return () => {
      asked += 1;
      for (const stop of stops) stop();
    };
  }

  /** The user has acknowledged the gap. */
  forget_missed(): void {
    this.missed.value = undefined;
  }

  set_phase(phase: Phase, reason: string): void {
    const before = this.view.value;
    if (before.phase === phase && before.reason === reason && before.since !== 0) return;
    const since = before.phase === phase && before.since !== 0 ? before.since : this.environment.now();
    this.view.value = { phase, since, reason };
  }

  private trouble(state: 'connecting' | 'lost', reason: string): void {
    const before = this.view.value;
    const phase = troubled(before, state, reason);
    // The first reason is kept: that of a failed retry says no more.
    const was_said = phase === before.phase && phase !== state && !refusals.test(reason) && !going_away.test(reason);
    this.set_phase(phase, was_said ? before.reason : reason);
  }

  private note_gap(gap: Gap): void {
    if (gap.reason === 'buffer') return; // concerns a stream of the client; the console reads no streams
    const before = this.missed.value?.gap;
    const sum = gap.reason === 'lost' && before?.reason === 'lost' ? { ...gap, first: before.first, count: gap.count + before.count } : gap;
    this.missed.value = { at: this.environment.now(), gap: sum };
  }

  // A browser hides why a WebSocket failed to open, so a plain HTTP request asks for the reason.
  private async outlook(token: string | undefined): Promise<Outlook> {
    const headers: HeadersInit = token === undefined ? {} : { Authorization: `Bearer ${token}` };
    try {
      const answer = await this.environment.fetch('/rois', { headers, cache: 'no-store' });
      const reason = /<reason>([^<]*)<\/reason>/.exec(await answer_text(answer))?.[1] ?? `status ${answer.status}`;
      if (answer.status === 401) return { phase: 'token', reason: token === undefined ? '' : reason };
      if (answer.status === 503) return { phase: 'draining', reason };
      if (answer.status === 403 || answer.status === 429) return { phase: 'refused', reason };
      return 'reachable';
    } catch {
      return 'unreachable';
    }
  }
}

const refusals = /^(too_many|not_allowed|unauthorized):/;
const going_away = /closed with (1001|1012|1013)\b|^shutting_down:/;

// The gateway's last refusal counts until a new request has been answered.
function troubled(before: LinkView, state: 'connecting' | 'lost', reason: string): Phase {
  if (refusals.test(reason)) return 'refused';
  if (going_away.test(reason)) return 'draining';
  if (before.phase === 'refused' || before.phase === 'draining') return before.phase;
  return state;
}
