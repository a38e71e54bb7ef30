// Stop for everything: halts all robots of a gateway, also those that other sessions command. Needs no session, and works while a
// client's link is lost.
import { answer_text } from './answer_text.js';
import { stop_state_of } from './answers.js';
import { RoisError } from './errors.js';
import type { StopState } from './messages.js';
import { socket_url } from './socket.js';
import { parse_xml } from './xml.js';

export interface EverythingOptions {
  /** Sent as Authorization: Bearer. */
  token?: string;
  /** ms until it rejects with `unreachable`: 10,000. */
  deadline?: number;
}

/**
 * Halts every component of every session; nothing starts until `clear_everything`. Gives the state afterwards: `not_halted` names the
 * components that have not confirmed yet that they stand still. Rejects with RoisError: `unreachable` without an answer, `fault` when the
 * gateway refuses, `protocol` when the answer is not a stop_state document. A page may stop only the gateway that serves it: the browser
 * hides the answers of others.
 */
export function stop_everything(url: string, options: EverythingOptions = {}): Promise<StopState> {
  return post(url, 'stop', options);
}

/** Allows commands again. Returns the state after that. */
export function clear_everything(url: string, options: EverythingOptions = {}): Promise<StopState> {
  return post(url, 'clear', options);
}

async function post(url: string, what: string, { token, deadline = 10_000 }: EverythingOptions): Promise<StopState> {
  const to = `${socket_url(url, token).replace('ws', 'http')}/${what}`;
  const headers: Record<string, string> = token === undefined ? {} : { Authorization: `Bearer ${token}` };
  try {
    const answer = await fetch(to, { method: 'POST', headers, redirect: 'error', signal: AbortSignal.timeout(deadline) });
    if (answer.ok) return read_stop_state(await answer_text(answer));
    throw new RoisError('fault', `${to} answers with HTTP status ${answer.status}`);
  } catch (error) {
    throw error instanceof RoisError ? error : new RoisError('unreachable', `${to}: ${error}`);
  }
}

/** Parses the answer of /rois/stop and /rois/clear. Throws RoisError `protocol` for any other text. */
export function read_stop_state(text: string): StopState {
  try {
    return stop_state_of(parse_xml(text));
  } catch (error) {
    throw error instanceof RoisError ? error : new RoisError('protocol', `the answer is not a stop_state document: ${error}`);
  }
}
