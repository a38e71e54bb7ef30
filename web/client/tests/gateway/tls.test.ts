// wss through a TLS proxy before the gateway. For missed notifications over TLS see endurance.test.ts.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';

import { connect } from 'rois-client';

import { Gateway, root } from '../kit/gateway.js';
import { bring_client, in_chromium } from '../kit/page.js';
import { output_of } from '../kit/program.js';
import { TlsProxy } from '../kit/tls_proxy.js';

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

// Prints the number of components if Node trusts the certificate, else the error.
const program = `import { connect } from '${root}/web/client/dist/node.js';
  await connect(process.env.ROIS_URL).then(async (client) => {
    console.log((await client.search()).length);
    await client.close();
  }, (error) => console.log(error.failure, error.message));`;
const output_of_node = (url: string, { certificate }: TlsProxy) =>
  output_of([process.execPath, '--input-type=module', '-e', program], url, { NODE_EXTRA_CA_CERTS: certificate });

test('Node connects if it trusts the certificate', async () => {
  for (const url of [tls.url, tls.url.replace('https', 'wss')]) assert.equal(await output_of_node(url, tls), '15\n', url);
});

// The deadline is longer than a test may take: none of these waits for it.
test('Node rejects an untrusted certificate at once', async () => {
  const patient = { deadline: 1_000_000 };
  await assert.rejects(connect(tls.url, patient), { failure: 'unreachable', message: "the gateway's certificate is rejected: self-signed certificate" });
  await assert.rejects(connect(`https://127.0.0.1:${gateway.port}`, patient), { failure: 'unreachable', message: /^the TLS handshake failed: / });
  const other = await TlsProxy.before(gateway.port, 'DNS:robot.example');
  assert.match(await output_of_node(other.url, other), /^unreachable the gateway's certificate is rejected: .*IP: 127\.0\.0\.1 is not in the cert's list/);
  await other.stop();
});

test('a page served over TLS connects over TLS', () =>
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

test('a browser rejects an untrusted certificate, and the error points to its console', () =>
  in_chromium(async (page) => {
    const complaint = page.waitForEvent('console');
    const why = await page.evaluate(async (to) => {
      const { connect } = await import('rois-client');
      return connect(to, { deadline: 3000, first_delay: 50 }).then(String, String);
    }, tls.url);
    assert.ok(why.startsWith(`RoisError: no session within 3000 ms: the WebSocket to ${tls.url.replace('https', 'wss')}/rois could not be opened; the browser's console may say why`), why);
    assert.match((await complaint).text(), /ERR_CERT_AUTHORITY_INVALID/);
  }));
