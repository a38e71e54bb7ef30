// What can go wrong with a call.

/** What an operation answers (RoIS, table 1). */
export type ReturnCode = 'OK' | 'ERROR' | 'BAD_PARAMETER' | 'UNSUPPORTED' | 'OUT_OF_RESOURCES' | 'TIMEOUT';

/** How a command ended (table 8). */
export type CompletedStatus = 'OK' | 'ERROR' | 'ABORT' | 'OUT_OF_RESOURCES' | 'TIMEOUT';

/** What kind of error a `receive_error` tells of (table 7). */
export type ErrorType = 'ENGINE_INTERNAL_ERROR' | 'COMPONENT_INTERNAL_ERROR' | 'COMPONENT_NOT_RESPONDING' | 'USER_DEFINED_ERROR';

/** How a component is (table 33). BUSY: another session has it bound. */
export type ComponentStatus = 'UNINITIALIZED' | 'READY' | 'BUSY' | 'WARNING' | 'ERROR';

/**
 * Why a call failed:
 * - `refused`: the engine answered with another return code than OK, see `return_code`;
 * - `fault`: the gateway could not read the message or did not allow it, see `fault`; no operation ran;
 * - `deadline`: no answer within the time that the caller gave; whether the operation ran is not known;
 * - `link_lost`: the link broke before the answer came, and what was sent must not be repeated unasked (`send`);
 * - `session_lost`: the session ended, with its bindings, commands and subscriptions;
 * - `unreachable`: no session could be had in the first place;
 * - `closed`: the client was closed;
 * - `invalid`: what was to be sent cannot be said in XML;
 * - `protocol`: the other side does not speak as an engine does.
 */
export type Failure =
  | 'refused'
  | 'fault'
  | 'deadline'
  | 'link_lost'
  | 'session_lost'
  | 'unreachable'
  | 'closed'
  | 'invalid'
  | 'protocol';

/** A fault's code, and the place in the document that it was about: line and column count from 1. */
export interface Fault {
  code: string;
  reason: string;
  line?: number;
  column?: number;
}

/** Every call that fails rejects with one of these. */
export class RoisError extends Error {
  override readonly name = 'RoisError';
  /** Set when `failure` is `refused`. */
  readonly return_code?: Exclude<ReturnCode, 'OK'>;
  /** Set when `failure` is `fault`. */
  readonly fault?: Fault;

  constructor(
    readonly failure: Failure,
    message: string,
    more: { return_code?: Exclude<ReturnCode, 'OK'>; fault?: Fault; cause?: unknown } = {},
  ) {
    super(message, 'cause' in more ? { cause: more.cause } : undefined);
    if (more.return_code !== undefined) this.return_code = more.return_code;
    if (more.fault !== undefined) this.fault = more.fault;
  }
}
