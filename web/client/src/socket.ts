// The WebSocket interface that a link needs.
import { RoisError } from './errors.js';

/** Why a socket failed to open, or ended. */
export interface SocketEnd {
  reason: string;
  /** A retry would fail in the same way. */
  final: boolean;
  /** Close code of the other side (RFC 6455, 7.4.1). */
  code?: number;
}

/** Called in this order: `opened` once, `received` for each text, `ended` once. If the socket does not open, only `ended`. */
export interface SocketListener {
  opened(): void;
  received(text: string): void;
  ended(end: SocketEnd): void;
}

export interface Socket {
  send(text: string): void;
  /** Closes the socket. The listener is not called again. */
  close(): void;
}

/** Starts to open a socket. Does not throw, and calls the listener only after it has returned. */
export interface OpenSocket {
  (url: string, subprotocols: string[], listener: SocketListener): Socket;
  /** Pings are answered outside the application's thread, so also while it hangs. */
  answers_pings_alone?: boolean;
}

export const subprotocol = 'rois.xml.v1';

/** The subprotocols to offer. A token is the second one, because a page cannot set headers. */
export function subprotocols_with(token: string | undefined): string[] {
  return token === undefined ? [subprotocol] : [subprotocol, `rois.bearer.${base64url(token)}`];
}

function base64url(text: string): string {
  const bytes = String.fromCharCode(...new TextEncoder().encode(text));
  return btoa(bytes).replace(/\+/g, '-').replace(/\//g, '_').replace(/=+$/, '');
}

/**
 * The WebSocket URL for http(s)://host[/path] or ws(s)://... Throws RoisError `invalid`, also if the token would be sent to another
 * machine without TLS.
 */
export function socket_url(url: string, token?: string): string {
  let at: URL;
  try {
    at = new URL(url);
  } catch {
    throw new RoisError('invalid', `'${url}' is not a URL: expected http://HOST:PORT, or https, ws or wss`);
  }
  if (!/^(https?|wss?):$/.test(at.protocol)) throw new RoisError('invalid', `'${url}': unknown scheme, expected http, https, ws or wss`);
  const is_here = /^(localhost|127(\.\d+){3}|\[::1\])$/.test(at.hostname);
  if (token !== undefined && !is_here && /^(http|ws):$/.test(at.protocol))
    throw new RoisError('invalid', `a token is not sent to '${at.hostname}' without TLS, which others could read: expected https or wss`);
  const path = at.pathname.replace(/\/+$/, '');
  return `${at.protocol.replace('http', 'ws')}//${at.host}${path.endsWith('/rois') ? path : `${path}/rois`}`;
}
