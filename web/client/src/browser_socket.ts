// The WebSocket that every browser has.
import type { OpenSocket } from './socket.js';

/** A page is not told why a socket does not open, so no end is final. */
export const open_browser_socket: OpenSocket = (url, subprotocols, listener) => {
  const socket = new WebSocket(url, subprotocols);
  let told = true;
  socket.onopen = () => told && listener.opened();
  socket.onmessage = ({ data }) => {
    if (told && typeof data === 'string') listener.received(data);
  };
  socket.onclose = ({ code, reason }) => {
    if (told) listener.ended({ reason: `the WebSocket was closed with ${code}${reason && `, ${reason}`}`, final: false });
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
