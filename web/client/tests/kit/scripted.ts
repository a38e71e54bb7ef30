// A gateway played by the test: records requests and sends scripted answers, on a fake clock.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { Client, type ClientOptions, namespaces, type OpenSocket, parse_xml, type Socket, type SocketListener, type XmlElement } from 'rois-client';

import { Clock, settled } from './clock.js';

/** The gateway's end of one WebSocket. */
export class ScriptedSocket implements Socket {
  readonly came: XmlElement[] = [];
  readonly texts: string[] = []; // unchanged
  closed = false; // by the client
  private ended = false; // by the gateway
  private answered = 0;

  constructor(
    readonly url: string,
    readonly subprotocols: string[],
    private readonly listener: SocketListener,
  ) {}

  send(text: string): void {
    this.came.push(parse_xml(text));
    this.texts.push(text);
  }
  close(): void {
    assert.ok(!this.is_over, 'the socket has ended already');
    this.closed = true;
  }

  get is_over(): boolean {
    return this.closed || this.ended;
  }
  get names(): string[] {
    return this.came.map((one) => one.name);
  }

  async open(): Promise<void> {
    if (!this.closed) this.listener.opened();
    await settled();
  }

  async say(text: string): Promise<void> {
    if (!this.closed) this.listener.received(text);
    await settled();
  }

  /** `code`: close code of the gateway. */
  async end(reason: string, final = false, code?: number): Promise<void> {
    this.ended = true;
    if (!this.closed) this.listener.ended(code === undefined ? { reason, final } : { reason, final, code });
    await settled();
  }

  /** Answers the oldest unanswered request, by default with OK. */
  answer(content = '', return_code = 'OK'): Promise<void> {
    const { name, id } = this.oldest();
    return this.say(`<${name}_response xmlns="${namespaces.message}" return_code="${return_code}" ${id}>${content}</${name}_response>`);
  }

  fault(code: string): Promise<void> {
    return this.say(`<fault xmlns="${namespaces.message}" code="${code}" ${this.oldest().id}><reason>says the script</reason></fault>`);
  }

  event(sequence: number, subscribe_id: string): Promise<void> {
    const event = `<event_id>e</event_id><event_type>t</event_type><subscribe_id>${subscribe_id}</subscribe_id><expire>2026-11-22T12:40:19.001Z</expire>`;
    const of = `<component_ref xmlns:rois="${namespaces.rois}" rois:code="c"/>`;
    return this.say(`<receive_event xmlns="${namespaces.message}" sequence="${sequence}">${event}${of}</receive_event>`);
  }

  completed(sequence: number, command_id = 'c', status = 'OK'): Promise<void> {
    return this.say(`<completed xmlns="${namespaces.message}" sequence="${sequence}"><command_id>${command_id}</command_id><status>${status}</status></completed>`);
  }

  private oldest(): { name: string; id: string } {
    const request = this.came[this.answered++]!;
    const id = request.attribute('request_id');
    return { name: request.name, id: id === undefined ? '' : `request_id="${id}"` };
  }
}

export class Scripted {
  readonly sockets: ScriptedSocket[] = [];

  readonly open: OpenSocket = (url, subprotocols, listener) => {
    const socket = new ScriptedSocket(url, subprotocols, listener);
    this.sockets.push(socket);
    return socket;
  };

  /** The newest socket. */
  get socket(): ScriptedSocket {
    return this.sockets.at(-1)!;
  }
}

/** Records what happens to a client, a word each. */
export function news_of(client: Client): string[] {
  const news: string[] = [];
  client.on('state', ({ state }) => news.push(state));
  client.on('gap', (gap) => news.push(gap.reason === 'lost' ? `lost ${gap.count}: ${gap.first} to ${gap.last}` : `gap: ${gap.reason}`));
  client.on('notification', ({ sequence }) => news.push(`${sequence}`));
  return news;
}

export const options: ClientOptions = { first_delay: 100, most_delay: 1000, heartbeat: 10_000, random: () => 0 };

/** Defines a test with a client in session `one`. Closes the client and checks that no timer is left. */
export function scripted(name: string, more: ClientOptions, dialogue: (client: Client, gateway: Scripted, clock: Clock) => Promise<void>): void {
  test(name, async () => {
    const [clock, gateway] = [new Clock(), new Scripted()];
    try {
      const client = new Client('https://robot', { ...options, ...more }, gateway.open);
      const started = client.start();
      await gateway.socket.open();
      await gateway.socket.answer('<session>one</session>');
      await started;
      await dialogue(client, gateway, clock);
      const closing = client.close();
      await clock.pass(5000); // longer than it waits for an answer
      await closing;
      assert.ok(gateway.sockets.every((one) => one.is_over));
      assert.equal(clock.waits, 0, 'timers');
    } finally {
      clock.remove();
    }
  });
}
