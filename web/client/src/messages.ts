// What the engine tells on its own (table 6), the gaps in it, and the state of the stop for everything.
import type { CompletedStatus, ErrorType } from './errors.js';
import type { Identifier, Results } from './values.js';

/** An event that was subscribed to. */
export interface ReceiveEvent {
  name: 'receive_event';
  sequence: number;
  event_id: string;
  event_type: string;
  subscribe_id: string;
  expire: Date; // until then `get_event_detail` knows it
  component_ref: Identifier;
  results: Results; // empty when the subscription does not ask for them inline
}

/** An error of the engine, or of a component that is bound or subscribed to. */
export interface ReceiveError {
  name: 'receive_error';
  sequence: number;
  error_id: string;
  error_type: ErrorType;
  component_ref?: Identifier;
}

/** A command has ended. */
export interface Completed {
  name: 'completed';
  sequence: number;
  command_id: string;
  status: CompletedStatus;
}

/** So many notifications were dropped by the engine; the last of them had this sequence. */
export interface Lost {
  name: 'lost';
  sequence: number;
  count: number;
}

/** Components have come or gone. */
export interface ProfileChanged {
  name: 'profile_changed';
  sequence: number;
}

export type Notification = ReceiveEvent | ReceiveError | Completed | Lost | ProfileChanged;

/** What /rois/stop and /rois/clear answer with. */
export interface StopState {
  /** Nothing starts until it is cleared. */
  stopped: boolean;
  /** The refs of the components that have not confirmed yet that they stand still. */
  not_halted: string[];
}

/**
 * Something was missed:
 * - `lost`: the engine dropped notifications `first` to `last` of the session, since too many waited; `count` of them are missing;
 * - `session`: the session was lost. What happened until the new one is not known, nor how much it was;
 * - `buffer`: whoever reads a stream of this client was too slow; its oldest `count` entries were dropped.
 */
export type Gap =
  | { reason: 'lost'; count: number; first: number; last: number }
  | { reason: 'session' }
  | { reason: 'buffer'; count: number };
