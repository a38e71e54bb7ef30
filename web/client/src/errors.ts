// Errors of calls.

/** Return code of an operation (RoIS, table 1). */
export type ReturnCode = 'OK' | 'ERROR' | 'BAD_PARAMETER' | 'UNSUPPORTED' | 'OUT_OF_RESOURCES' | 'TIMEOUT';

/** How a command ended (table 8). */
export type CompletedStatus = 'OK' | 'ERROR' | 'ABORT' | 'OUT_OF_RESOURCES' | 'TIMEOUT';

/** Type of a `receive_error` (table 7). */
export type ErrorType = 'ENGINE_INTERNAL_ERROR' | 'COMPONENT_INTERNAL_ERROR' | 'COMPONENT_NOT_RESPONDING' | 'USER_DEFINED_ERROR';

/** Status of a component (table 33). BUSY: bound by another session. */
export type ComponentStatus = 'UNINITIALIZED' | 'READY' | 'BUSY' | 'WARNING' | 'ERROR';

/**
 * Why a call failed:
 * - `refused`: the engine answered with a return code other than OK, see `return_code`;
 * - `fault`: the gateway could not read or did not allow the message, see `fault`; no operation ran;
 * - `deadline`: no answer within the timeout; the operation may or may not have run;
 * - `link_lost`: the link broke before the answer, and the message may not be repeated (`send`);
 * - `session_lost`: the session ended, with its bindings, commands and subscriptions;
 * - `unreachable`: no session could be opened;
 * - `closed`: the client is closed;
 * - `invalid`: the arguments are invalid or cannot be written as XML;
 * - `protocol`: the answer violates the protocol.
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

/** A fault with its place in the document; line and column count from 1. */
export interface Fault {
  code: string;
  reason: string;
  line?: number;
  column?: number;
}

/** The error of every failed call. */
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
