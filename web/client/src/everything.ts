// Stop for everything: halts all robots of a gateway, whoever commands them. Needs no session, and works while a client's link is lost.
import { RoisError } from './errors.js';
import { socket_url } from './socket.js';

export interface EverythingOptions {
  /** Sent as Authorization: Bearer. */
  token?: string;
  /** ms until it rejects with `unreachable`: 10,000. */
  deadline?: number;
}

/**
 * Halts every component of every session; nothing starts until `clear_everything`. Gives the refs of the components that have not confirmed yet
 * that they stand still. Rejects with RoisError: `unreachable` without an answer, `fault` when the gateway refuses. A page may stop only the
 * gateway that serves it: it is not told the answers of others.
 */
export async function stop_everything(url: string, options: EverythingOptions = {}): Promise<string[]> {
  const lines = (await post(url, 'stop', options)).split('\n');
  return lines.filter((line) => line.startsWith(not_confirmed)).map((line) => line.slice(not_confirmed.length));
}

/** Lets commands start again. */
export async function clear_everything(url: string, options: EverythingOptions = {}): Promise<void> {
  await post(url, 'clear', options);
}

const not_confirmed = 'not confirmed yet: ';

async function post(url: string, what: string, { token, deadline = 10_000 }: EverythingOptions): Promise<string> {
  const to = `${socket_url(url).replace('ws', 'http')}/${what}`;
  const headers: Record<string, string> = token === undefined ? {} : { Authorization: `Bearer ${token}` };
  try {
    const answer = await fetch(to, { method: 'POST', headers, signal: AbortSignal.timeout(deadline) });
    if (answer.ok) return await answer.text();
    throw new RoisError('fault', `${to} answers with ${answer.status}`);
  } catch (error) {
    throw error instanceof RoisError ? error : new RoisError('unreachable', `${to}: ${error}`);
  }
}
