// What a link needs of a WebSocket: the browser's own or that of node_socket.ts.
import { RoisError } from './errors.js';

/** Why a socket could not be opened, or ended. */
export interface SocketEnd {
  reason: string;
  /** The other side has said that it will not have us, and says so again when asked again. */
  final: boolean;
  /** With which the other side has closed it (RFC 6455, 7.4.1). */
  code?: number;
}

/** What a socket tells, in this order: `opened` once, `received` for each text, `ended` once; only `ended` when it does not open. */
export interface SocketListener {
  opened(): void;
  received(text: string): void;
  ended(end: SocketEnd): void;
}

export interface Socket {
  send(text: string): void;
  /** Ends it; nothing is told any more. */
  close(): void;
}

/** Begins to open a socket; never throws, and tells nothing before it has returned. */
export interface OpenSocket {
  (url: string, subprotocols: string[], listener: SocketListener): Socket;
  /** Pings are answered elsewhere than on the application's thread, and so also while that hangs. */
  answers_pings_alone?: boolean;
}

export const subprotocol = 'rois.xml.v1';

/** What is asked for; a token is the second one, since a page cannot set headers. */
export function subprotocols_with(token: string | undefined): string[] {
  return token === undefined ? [subprotocol] : [subprotocol, `rois.bearer.${base64url(token)}`];
}

function base64url(text: string): string {
  const bytes = String.fromCharCode(...new TextEncoder().encode(text));
  return btoa(bytes).replace(/\+/g, '-').replace(/\//g, '_').replace(/=+$/, '');
}

/** http(s)://host[/path] or ws(s)://...: the WebSocket's address below it. */
export function socket_url(url: string): string {
  let at: URL;
  try {
    at = new URL(url);
  } catch {
    throw new RoisError('invalid', `'${url}' is no URL`);
  }
  if (!/^(https?|wss?):$/.test(at.protocol)) throw new RoisError('invalid', `a gateway is not reached by ${at.protocol}`);
  const path = at.pathname.replace(/\/+$/, '');
  return `${at.protocol.replace('http', 'ws')}//${at.host}${path.endsWith('/rois') ? path : `${path}/rois`}`;
}
