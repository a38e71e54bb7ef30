// The WebSocket that every browser has.
import type { OpenSocket } from './socket.js';

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
    const why = was_open ? `was closed with ${code}${reason && `, ${reason}`}` : "could not be opened; the browser's console may say why";
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
