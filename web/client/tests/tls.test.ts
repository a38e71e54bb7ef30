// wss: a proxy before the gateway ends TLS. That nothing is missed there either: endurance.test.ts.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';

import { connect } from 'rois-client';

import { Gateway, root } from './gateway.js';
import { bring_client, in_chromium } from './page.js';
import { output_of } from './program.js';
import { TlsProxy } from './tls_proxy.js';

let gateway: Gateway;
let tls: TlsProxy;
before(async () => {
  gateway = await Gateway.start('--scenario', `${root}/tests/server/data/empty_hall.xml`, '--sim-speed', '100');
  tls = await TlsProxy.before(gateway.port);
});
after(async () => {
  await tls.stop();
  await gateway.stop();
});

// How many components a program finds that trusts the certificate, or why none.
const program = `import { connect } from '${root}/web/client/dist/node.js';
  await connect(process.env.ROIS_URL).then(async (client) => {
    console.log((await client.search()).length);
    await client.close();
  }, (error) => console.log(error.failure, error.message));`;
const told_in_node = (url: string, { certificate }: TlsProxy) =>
  output_of([process.execPath, '--input-type=module', '-e', program], url, { NODE_EXTRA_CA_CERTS: certificate });

test('Node speaks with whom it trusts', async () => {
  for (const url of [tls.url, tls.url.replace('https', 'wss')]) assert.equal(await told_in_node(url, tls), '15\n', url);
});

// The deadline is longer than a test may last: none of these waits for it.
test('Node says at once whom it does not trust', async () => {
  const patient = { deadline: 1_000_000 };
  await assert.rejects(connect(tls.url, patient), { failure: 'unreachable', message: "the gateway's certificate is refused: self-signed certificate" });
  await assert.rejects(connect(`https://127.0.0.1:${gateway.port}`, patient), { failure: 'unreachable', message: /^TLS cannot be spoken there: / });
  const other = await TlsProxy.before(gateway.port, 'DNS:robot.example');
  assert.match(await told_in_node(other.url, other), /^unreachable the gateway's certificate is refused: .*IP: 127\.0\.0\.1 is not in the cert's list/);
  await other.stop();
});

test('a page that came over TLS speaks over TLS', () =>
  in_chromium(async (page) => {
    await bring_client(page, tls.url);
    const came = await page.evaluate(async () => {
      const { connect, Navigation }: typeof import('rois-client') = await import(`${location.origin}/dist/browser.js`);
      const client = await connect();
      const status = String(await (await Navigation.bind_any(client)).go_to({ x: 6500, y: 6000, th: 0 }));
      await client.close();
      return { status, protocol: location.protocol };
    });
    assert.deepEqual(came, { status: 'OK', protocol: 'https:' });
  }, tls.chromium_switch));

test('a browser refuses whom it does not trust, and its console says why', () =>
  in_chromium(async (page) => {
    const complaint = page.waitForEvent('console');
    const why = await page.evaluate(async (to) => {
      const { connect } = await import('rois-client');
      return connect(to, { deadline: 3000, first_delay: 50 }).then(String, String);
    }, tls.url);
    assert.ok(why.startsWith(`RoisError: no session within 3000 ms: the WebSocket to ${tls.url.replace('https', 'wss')}/rois could not be opened; the browser's console may say why`), why);
    assert.match((await complaint).text(), /ERR_CERT_AUTHORITY_INVALID/);
  }));
