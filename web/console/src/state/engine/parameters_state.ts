// Parameters of components, polled by `get_parameter` while they are watched.
import { signal } from '@preact/signals';
import type { Results } from 'rois-client';

import type { Poll } from '../base/poll';
import type { OwnRequests } from '../session/own_requests';

export class ParametersState {
  private readonly all = signal<ReadonlyMap<string, Results>>(new Map());
  private readonly polls = new Map<string, Poll>();

  constructor(
    private readonly requests: OwnRequests,
    private readonly period = 1500, // ms
  ) {}

  /** The latest parameters; undefined if not received. */
  of(ref: string): Results | undefined {
    return this.all.value.get(ref);
  }

  /** The component's own poll, always the same object. */
  poll(ref: string): Poll {
    const known = this.polls.get(ref);
    if (known) return known;
    const poll = this.requests.poll(this.period, () => this.ask(ref));
    this.polls.set(ref, poll);
    return poll;
  }

  private async ask(ref: string): Promise<void> {
    const results = await this.requests.query('get_parameter', ref);
    this.all.value = new Map([...this.all.value, [ref, results]]);
  }
}
