// While the link is cut 100 times at random during 10,000 events and 500 commands, no event is missed without a gap or received twice,
// and every command completes once.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { connect } from 'rois-client';

import { commands, endure, type Endured, events_each } from '../kit/endurance.js';
import { Gateway, root } from '../kit/gateway.js';
import { in_chromium } from '../kit/page.js';
import { output_of } from '../kit/program.js';
import { Proxy, random_from } from '../kit/proxy.js';
import { TlsProxy } from '../kit/tls_proxy.js';

const start = (...flags: string[]) => Gateway.start('--scenario', `${root}/tests/server/data/empty_hall.xml`, '--sim-speed', '100', ...flags);

async function cut_a_hundred_times(target: number, endured_at: (proxy: Proxy) => Promise<Endured>): Promise<void> {
  const proxy = await Proxy.before(target);
  try {
    proxy.cut_at_random(100, 50_000, random_from(7));
    const endured = await endured_at(proxy);
    assert.equal(proxy.cuts, 100);
    const { resumed, ...rest } = endured;
    assert.deepEqual(rest, {
      statuses: { OK: commands },
      events: commands * events_each,
      out_of_order: [],
      completed: commands,
      completed_twice: [],
      missed: 0,
      other_gaps: 0,
    });
    assert.ok(resumed > 50, `${resumed} of 100: a link may be cut again before it has resumed`);
  } finally {
    await proxy.stop();
  }
}

test('in Node, cuts lose nothing', async () => {
  const gateway = await start();
  await cut_a_hundred_times(gateway.port, ({ url }) => endure(connect, url)).finally(() => gateway.stop());
});

// Cuts inside TLS and its handshake. A separate program, because Node reads the trusted certificates when it starts.
test('in Node over TLS, cuts lose nothing', async () => {
  const gateway = await start();
  const tls = await TlsProxy.before(gateway.port);
  const program = `import { connect } from '${root}/web/client/dist/node.js';
    import { endure } from '${root}/web/client/build/tests/kit/endurance.js';
    console.log(JSON.stringify(await endure(connect, process.env.ROIS_URL)));`;
  try {
    await cut_a_hundred_times(tls.port, async ({ port }) => {
      const command = [process.execPath, '--input-type=module', '-e', program];
      return JSON.parse(await output_of(command, `wss://127.0.0.1:${port}`, { NODE_EXTRA_CA_CERTS: tls.certificate })) as Endured;
    });
  } finally {
    await tls.stop();
    await gateway.stop();
  }
});

test('in Chromium, cuts lose nothing', () =>
  in_chromium(async (page) => {
    const gateway = await start('--allowed-origins', new URL(page.url()).origin);
    const endured_at = ({ url }: Proxy) =>
      page.evaluate(async (to) => {
        const [{ endure: run }, { connect: to_connect }] = await Promise.all([import(`${location.origin}/tests/endurance.js`), import('rois-client')]);
        return run(to_connect, to) as Promise<Endured>;
      }, url);
    await cut_a_hundred_times(gateway.port, endured_at).finally(() => gateway.stop());
  }));
