// The package in a browser.
import { open_browser_socket } from './browser_socket.js';
import { Client, type ClientOptions } from './client.js';

export * from './index.js';
/** What a `Client` of one's own making is opened with; `connect` does it by itself. */
export { open_browser_socket as open_socket } from './browser_socket.js';

/** Connects to the gateway at this URL; without one, to that which serves the page. Rejects with RoisError `unreachable`. */
export async function connect(url: string = location.origin, options: ClientOptions = {}): Promise<Client> {
  const client = new Client(url, options, open_browser_socket);
  await client.start(options.deadline);
  return client;
}
