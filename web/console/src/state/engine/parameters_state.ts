// Parameters of components, polled by `get_parameter` while they are watched.
import { signal } from '@preact/signals';
import { type Client, component_ref, type Results } from 'rois-client';

import type { Documents } from '../session/documents';
import type { Environment } from '../base/environment';
import { Poll } from '../base/poll';

export class ParametersState {
  private readonly all = signal<ReadonlyMap<string, Results>>(new Map());
  private readonly polls = new Map<string, Poll>();

  constructor(
    private readonly environment: Environment,
    private readonly documents: Documents,
    private readonly client: () => Client | undefined,
    private readonly may_ask: () => boolean,
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
    const poll = new Poll(this.environment, this.period, () => this.ask(ref), this.may_ask);
    this.polls.set(ref, poll);
    return poll;
  }

  private async ask(ref: string): Promise<void> {
    const client = this.client();
    if (!client) return;
    const { results } = await this.documents.as_own(() => client.query('get_parameter', component_ref(ref)));
    this.all.value = new Map([...this.all.value, [ref, results]]);
  }
}
