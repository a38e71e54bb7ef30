// A client behind a proxy and the real gateway, with a record of events.
import { after, before, test } from 'node:test';

import { type Client, type ClientOptions, command, connect, type Gap, parse_xml, type StateChange } from 'rois-client';

import { Gateway, root } from './gateway.js';
import { Proxy } from './proxy.js';

export const flags = ['--scenario', `${root}/tests/server/data/empty_hall.xml`, '--sim-speed', '100'];
export const quick: ClientOptions = { first_delay: 5, most_delay: 20 };

/** One gateway for all tests of a file: an empty hall; keeps 30 sent notifications. */
export let gateway: Gateway;
before(async () => {
  gateway = await Gateway.start(...flags, '--max-sent-notifications', '30');
});
after(() => gateway.stop());

/** What happened to a client, in order. */
export interface Seen {
  states: string[];
  gaps: Gap[];
  out: string[]; // names of the sent documents
  until(state: string): Promise<void>;
}

export function watched(client: Client): Seen {
  const seen: Seen = {
    states: [],
    gaps: [],
    out: [],
    until: (state) =>
      new Promise((resolve) => {
        const stop = client.on('state', (change: StateChange) => {
          if (change.state !== state) return;
          stop();
          resolve();
        });
      }),
  };
  client.on('state', ({ state }) => seen.states.push(state));
  client.on('gap', (gap) => seen.gaps.push(gap));
  client.on('document', ({ direction, text }) => direction === 'out' && seen.out.push(parse_xml(text).name));
  return seen;
}

/** Defines a test. */
export function behind_a_proxy(name: string, options: ClientOptions, dialogue: (client: Client, proxy: Proxy, seen: Seen) => Promise<void>): void {
  test(name, async () => {
    const proxy = await Proxy.before(gateway.port);
    const client = await connect(proxy.url, { ...quick, ...options });
    try {
      await dialogue(client, proxy, watched(client));
    } finally {
      await client.close();
      await proxy.stop();
    }
  });
}

/** `count` events, numbered in their targets, and one `completed`. */
export const go = (client: Client, first: number, count: number) =>
  client.execute([command('navigation', 'start', { target_position: Array.from({ length: count }, (_, i) => `4000, 5000, ${first + i}e-9`) })]);

export const number_of = (target: string) => Number(/(\d+)e-9$/.exec(target)![1]);

/** Makes a request of the same session over HTTP. Returns the answer. */
export async function said_over_http(client: Client, operation: string, content = ''): Promise<string> {
  const names = 'xmlns="urn:x-rois:psm:xml:message:1" xmlns:rois="http://www.omg.org/spec/RoIS/20240801" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"';
  const headers = { 'Content-Type': 'application/xml', 'RoIS-Session': client.session };
  const answer = await fetch(`${gateway.url}/rois`, { method: 'POST', headers, body: `<${operation} ${names}>${content}</${operation}>` });
  return answer.text();
}
