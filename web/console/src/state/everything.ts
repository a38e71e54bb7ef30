// Stop for everything: whether all robots are stopped, by whomever, and the way to do it. Works without a session and without a link.
import { computed, signal } from '@preact/signals';

import type { Environment } from './environment';
import type { MetricsState } from './metrics_state';
import { reason_of } from './reason_of';

const deadline = 5000; // ms
const settled_after = 1500; // ms: an older scrape may have been under way when the gateway answered

export class EverythingState {
  /** Why the last press did not get through; empty when it did. */
  readonly trouble = signal('');
  private readonly said = signal({ at: 0, stopped: false, waiting: [] as readonly string[] });

  /** What the gateway has answered, until its metrics are newer. `waiting`: what has not confirmed yet that it stands still. */
  readonly view = computed<{ stopped: boolean; waiting: readonly string[] }>(() => {
    const scrape = this.metrics.latest.value;
    const said = this.said.value;
    if (!scrape || scrape.at < said.at + settled_after) return said;
    const stopped = (scrape.value('rois_everything_stopped') ?? 0) > 0;
    const count = stopped ? (scrape.value('rois_components_not_halted') ?? 0) : 0;
    return { stopped, waiting: count === 0 ? [] : said.waiting.length > 0 ? said.waiting : this.failing() };
  });

  /** `failing`: the components whose status is ERROR. */
  constructor(
    private readonly environment: Environment,
    private readonly token: () => string | undefined,
    private readonly metrics: MetricsState,
    private readonly failing: () => readonly string[],
  ) {}

  /** Never rejects: `trouble` says why it did not get through. */
  stop(): Promise<void> {
    return this.post('/rois/stop', true).then(
      () => void (this.trouble.value = ''),
      (error: unknown) => void (this.trouble.value = reason_of(error)),
    );
  }

  async clear(): Promise<void> {
    await this.post('/rois/clear', false);
    this.trouble.value = '';
  }

  private async post(path: string, stopped: boolean): Promise<void> {
    const token = this.token();
    const headers: HeadersInit = token === undefined ? {} : { Authorization: `Bearer ${token}` };
    const answer = await this.environment.fetch(path, { method: 'POST', headers, signal: AbortSignal.timeout(deadline) });
    if (!answer.ok) throw new Error(`status ${answer.status}`);
    const waiting = [...(await answer.text()).matchAll(/^not confirmed yet: (.*)$/gm)].map((one) => one[1]!);
    this.said.value = { at: this.environment.now(), stopped, waiting };
  }
}
