// Status of the components: polls `component_status` while watched.
import { signal } from '@preact/signals';
import { type Client, component_ref, type ComponentStatus, RoisError } from 'rois-client';

import type { Documents } from '../session/documents';
import type { Environment } from '../base/environment';
import { Poll } from '../base/poll';
import type { ComponentView } from './profile_state';

export interface StatusEntry {
  status: ComponentStatus | 'unknown'; // unknown: the query failed, see `trouble`
  at: number; // last query, ms since 1970
  since: number; // first seen with this status
  trouble?: string;
}

export class StatusState {
  /** By component_ref. */
  readonly all = signal<ReadonlyMap<string, StatusEntry>>(new Map());
  readonly poll: Poll;

  constructor(
    private readonly environment: Environment,
    private readonly documents: Documents,
    private readonly client: () => Client | undefined,
    private readonly components: () => readonly ComponentView[],
    may_ask: () => boolean,
    period = 1000, // ms
  ) {
    this.poll = new Poll(environment, period, () => this.ask(), may_ask);
  }

  of(ref: string): StatusEntry | undefined {
    return this.all.value.get(ref);
  }

  private async ask(): Promise<void> {
    const client = this.client();
    if (!client) return;
    const before = this.all.value;
    const asked = this.components()
      .filter((one) => one.queries.some((query) => query.name === 'component_status'))
      .map(async ({ ref }): Promise<[string, StatusEntry]> => {
        const now = await this.documents
          .as_own(() => client.query('component_status', component_ref(ref)))
          .then(({ results }) => ({ status: (results.text('status') ?? 'unknown') as StatusEntry['status'] }))
          .catch((error: unknown) => ({ status: 'unknown' as const, trouble: error instanceof RoisError ? error.message : String(error) }));
        const last = before.get(ref);
        const at = this.environment.now();
        return [ref, { ...now, at, since: last?.status === now.status ? last.since : at }];
      });
    this.all.value = new Map(await Promise.all(asked));
  }
}
