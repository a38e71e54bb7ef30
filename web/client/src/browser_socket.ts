// Uses the browser's WebSocket.
import type { OpenSocket } from './socket.js';

// A browser hides why a handshake failed. For a page of another origin than the gateway's, the origin is a likely cause.
function hint(url: string): string {
  const mine = globalThis.location?.origin;
  if (mine === undefined || mine === new URL(url.replace(/^ws/, 'http')).origin) return '';
  if (mine === 'null')
    return (
      '. If the gateway is running, it may refuse this page: ' +
      'pages without an origin (files, sandboxed frames) are never allowed. Serve the page over HTTP'
    );
  return `. If the gateway is running, it may refuse pages of ${mine}: RoIS Gateway allows them with --allowed-origins ${mine}`;
}

const longest = 64 * 1024 * 1024; // characters of a message

/** A page cannot know why a socket failed to open, so `final` is always false. */
export const open_browser_socket: OpenSocket = (url, subprotocols, listener) => {
  const socket = new WebSocket(url, subprotocols);
  let [listening, was_open] = [true, false];
  socket.onopen = () => {
    was_open = true;
    if (listening) listener.opened();
  };
  socket.onmessage = ({ data }) => {
    if (typeof data !== 'string' || data.length > longest) socket.close(4000, 'not a text, or too long');
    else if (listening) listener.received(data);
  };
  socket.onclose = ({ code, reason }) => {
    const why = was_open
      ? `was closed with ${code}${reason && `, ${reason}`}`
      : `to ${url} could not be opened; the browser's console may say why${hint(url)}`;
    if (listening) listener.ended({ reason: `the WebSocket ${why}`, final: false, code });
    listening = false;
  };
  return {
    send: (text) => socket.send(text),
    close: () => {
      listening = false;
      socket.close(1000);
    },
  };
};

open_browser_socket.answers_pings_alone = true;
