// Package entry for Node.
import { Client, type ClientOptions } from './client.js';
import { open_node_socket } from './node_socket.js';

export * from './index.js';
/** Opens the socket of a `Client` that the application constructs itself; `connect` passes it for you. */
export { open_node_socket as open_socket } from './node_socket.js';

/** Connects to the gateway at this URL. Rejects with RoisError `unreachable`. */
export async function connect(url: string = 'http://127.0.0.1:8080', options: ClientOptions = {}): Promise<Client> {
  const client = new Client(url, options, open_node_socket);
  await client.start(options.deadline);
  return client;
}
