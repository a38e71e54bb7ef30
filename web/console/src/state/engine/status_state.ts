// Status of the components: polls `component_status` while watched.
import { signal } from '@preact/signals';
import type { ComponentStatus } from 'rois-client';

import type { Environment } from '../base/environment';
import type { Poll } from '../base/poll';
import { reason_of } from '../base/reason_of';
import type { OwnRequests } from '../session/own_requests';
import type { ProfileState } from './profile_state';

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
    private readonly requests: OwnRequests,
    private readonly profile: ProfileState,
    period = 1000, // ms
  ) {
    this.poll = requests.poll(period, () => this.ask());
  }

  of(ref: string): StatusEntry | undefined {
    return this.all.value.get(ref);
  }

  private async ask(): Promise<void> {
    const before = this.all.value;
    const asked = this.profile.with_query('component_status').map(async ({ ref }): Promise<[string, StatusEntry]> => {
      const now = await this.requests
        .query('component_status', ref)
        .then((results) => ({ status: (results.text('status') ?? 'unknown') as StatusEntry['status'] }))
        .catch((error: unknown) => ({ status: 'unknown' as const, trouble: reason_of(error) }));
      const last = before.get(ref);
      const at = this.environment.now();
      return [ref, { ...now, at, since: last?.status === now.status ? last.since : at }];
    });
    this.all.value = new Map(await Promise.all(asked));
  }
}
