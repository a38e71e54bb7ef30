// The WebSocket that every browser has.
import type { OpenSocket } from './socket.js';

// A browser does not say why a handshake failed. For a page of another origin than the gateway's, the origin is a likely cause.
function hint(url: string): string {
  const mine = globalThis.location?.origin;
  if (mine === undefined || mine === new URL(url.replace(/^ws/, 'http')).origin) return '';
  if (mine === 'null') return ". If the gateway is running, it may refuse this page: a page without an origin (a file, a sandboxed frame) is never allowed. Serve the page over HTTP";
  return `. If the gateway is running, it may refuse pages of ${mine}: RoIS Gateway allows them with --allowed-origins ${mine}`;
}

/** A page is not told why a socket does not open, so no end is final. */
export const open_browser_socket: OpenSocket = (url, subprotocols, listener) => {
  const socket = new WebSocket(url, subprotocols);
  let [told, was_open] = [true, false];
  socket.onopen = () => {
    was_open = true;
    if (told) listener.opened();
  };
  socket.onmessage = ({ data }) => {
    if (told && typeof data === 'string') listener.received(data);
  };
  socket.onclose = ({ code, reason }) => {
    const why = was_open ? `was closed with ${code}${reason && `, ${reason}`}` : `to ${url} could not be opened; the browser's console may say why${hint(url)}`;
    if (told) listener.ended({ reason: `the WebSocket ${why}`, final: false, code });
    told = false;
  };
  return {
    send: (text) => socket.send(text),
    close: () => {
      told = false;
      socket.close(1000);
    },
  };
};

open_browser_socket.answers_pings_alone = true;
