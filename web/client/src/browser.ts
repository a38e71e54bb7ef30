// Package entry for browsers.
import { open_browser_socket } from './browser_socket.js';
import { Client, type ClientOptions } from './client.js';

export * from './index.js';
/** Opens the socket of a `Client` that the application constructs itself; `connect` passes it for you. */
export { open_browser_socket as open_socket } from './browser_socket.js';

/** Connects to the gateway at this URL, by default the one that serves the page. Rejects with RoisError `unreachable`. */
export async function connect(url: string = location.origin, options: ClientOptions = {}): Promise<Client> {
  const client = new Client(url, options, open_browser_socket);
  await client.start(options.deadline);
  return client;
}
