// Requests that the console sends for its own display.
import { type Client, component_ref, type Results } from 'rois-client';

import type { Environment } from '../base/environment';
import { Poll } from '../base/poll';
import type { Documents } from './documents';

export class OwnRequests {
  constructor(
    private readonly environment: Environment,
    private readonly documents: Documents,
    private readonly client: () => Client | undefined,
    private readonly is_open: () => boolean, // the link
  ) {}

  /** A poll that calls `ask` while it is watched, the link is open and `is_due` is true. */
  poll(period: number, ask: () => Promise<void>, is_due = () => true): Poll {
    return new Poll(this.environment, period, ask, () => this.is_open() && is_due());
  }

  /** Sends a request whose documents count as the console's own. Rejects if there is no client. */
  async send<Answer>(request: (client: Client) => Promise<Answer>): Promise<Answer> {
    const client = this.client();
    if (!client) throw new Error('not connected');
    return this.documents.as_own(() => request(client));
  }

  /** Queries a component. */
  async query(query_type: string, ref: string): Promise<Results> {
    return (await this.send((client) => client.query(query_type, component_ref(ref)))).results;
  }
}
