// Stop for everything: whether all robots are stopped, by any session, and the operations to stop and clear. Works without a session
// and a link.
import { computed, effect, signal } from '@preact/signals';
import { answer_text, read_stop_state } from 'rois-client';

import type { Environment } from '../base/environment';
import { Poll } from '../base/poll';
import { reason_of } from '../base/reason_of';
import type { MetricsState } from './metrics_state';

const deadline = 5000; // ms
const settled_after = 1500; // ms: an older scrape may have been under way when the gateway answered
const period = 250; // ms between two requests of /readyz; most components confirm within 500 ms

export interface EverythingView {
  stopped: boolean;
  /** The refs of the components that have not confirmed yet that they stand still. */
  waiting: readonly string[];
}

export class EverythingState {
  /** Why the last `stop()` failed; empty after a success. */
  readonly trouble = signal('');
  private readonly answered = signal({ at: 0, stopped: false, waiting: [] as readonly string[] });

  /** The gateway's last answer. Valid until its metrics are newer. */
  readonly view = computed<EverythingView>(() => {
    const { stopped, waiting } = this.known();
    return { stopped, waiting };
  });

  private readonly is_unconfirmed = computed(() => {
    const { stopped, count } = this.known();
    return stopped && count > 0;
  });

  constructor(
    private readonly environment: Environment,
    private readonly token: () => string | undefined,
    private readonly metrics: MetricsState,
  ) {
    const confirmations = new Poll(environment, period, () => this.ask());
    effect(() => (this.is_unconfirmed.value ? confirmations.watch() : undefined));
  }

  /** Never rejects: `trouble` has the reason of a failure. */
  stop(): Promise<void> {
    return this.post('/rois/stop').then(
      () => void (this.trouble.value = ''),
      (error: unknown) => void (this.trouble.value = reason_of(error)),
    );
  }

  async clear(): Promise<void> {
    await this.post('/rois/clear');
    this.trouble.value = '';
  }

  private known(): { stopped: boolean; waiting: readonly string[]; count: number } {
    const scrape = this.metrics.latest.value;
    const answered = this.answered.value;
    if (!scrape || scrape.at < answered.at + settled_after) return { ...answered, count: answered.waiting.length };
    const stopped = (scrape.value('rois_everything_stopped') ?? 0) > 0;
    const count = stopped ? (scrape.value('rois_components_not_halted') ?? 0) : 0;
    return { stopped, waiting: count > 0 ? answered.waiting : [], count };
  }

  private async post(path: string): Promise<void> {
    const answer = await this.fetch(path, 'POST');
    if (!answer.ok) throw new Error(`status ${answer.status}`);
    const { stopped, not_halted } = read_stop_state(await answer_text(answer));
    this.answered.value = { at: this.environment.now(), stopped, waiting: not_halted };
  }

  // Finds the components that have not confirmed yet. /readyz has a line for each of them, and one while everything is stopped.
  private async ask(): Promise<void> {
    const before = this.answered.peek();
    const answer = await this.fetch('/readyz', 'GET');
    const text = await answer_text(answer);
    const stopped = text.startsWith('stopped');
    const waiting = [...text.matchAll(/^(.*) has not confirmed that it stands still$/gm)].map((one) => one[1]!);
    const is_known = answer.ok || stopped || waiting.length > 0; // else /readyz reports another problem
    if (is_known && this.answered.peek() === before) this.answered.value = { at: this.environment.now(), stopped, waiting };
  }

  private fetch(path: string, method: string): Promise<Response> {
    const token = this.token();
    const headers: HeadersInit = token === undefined ? {} : { Authorization: `Bearer ${token}` };
    return this.environment.fetch(path, { method, headers, cache: 'no-store', signal: AbortSignal.timeout(deadline) });
  }
}
