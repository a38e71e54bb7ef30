// Notifications of the engine (table 6), gaps in them, and the state of the stop for everything.
import type { CompletedStatus, ErrorType } from './errors.js';
import type { Identifier, Results } from './values.js';

/** An event of a subscription. */
export interface ReceiveEvent {
  name: 'receive_event';
  sequence: number;
  event_id: string;
  event_type: string;
  subscribe_id: string;
  expire: Date; // end of `get_event_detail` for this event
  component_ref: Identifier;
  results: Results; // empty unless the subscription has inline results
}

/** An error of the engine, or of a component that the session has bound or subscribed to. */
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

/** The engine dropped `count` notifications, the last with this sequence number. */
export interface Lost {
  name: 'lost';
  sequence: number;
  count: number;
}

/** Components were added or removed. */
export interface ProfileChanged {
  name: 'profile_changed';
  sequence: number;
}

/**
 * A running command of a logical component goes on with another member. The session receives it if it bound the component with
 * `switching` or connected with `switches`.
 */
export interface Switched {
  name: 'switched';
  sequence: number;
  component_ref: Identifier;
  from: string; // the ref of the member; may be empty
  to: string;
  reason: string;
}

export type Notification = ReceiveEvent | ReceiveError | Completed | Lost | ProfileChanged | Switched;

/** The answer of /rois/stop and /rois/clear. */
export interface StopState {
  /** Whether commands are blocked until `clear_everything`. */
  stopped: boolean;
  /** Refs of components that have not confirmed their halt. */
  not_halted: string[];
}

/**
 * Notifications are missing:
 * - `lost`: the engine's queue was full; it dropped notifications `first` to `last` of the session, `count` in all;
 * - `session`: the session was lost; how many notifications are missing is unknown;
 * - `buffer`: a stream of this client was not read fast enough; its oldest `count` entries were dropped.
 */
export type Gap =
  | { reason: 'lost'; count: number; first: number; last: number }
  | { reason: 'session' }
  | { reason: 'buffer'; count: number };
