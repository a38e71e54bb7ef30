// Differences in a browser. For missed notifications in a browser see endurance.test.ts.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { Gateway, root } from '../kit/gateway.js';
import { bring_client, in_chromium } from '../kit/page.js';

const flags = ['--scenario', `${root}/tests/server/data/empty_hall.xml`, '--sim-speed', '100'];

test('without a URL, a page connects to the gateway that serves it', (t) =>
  in_chromium(async (page) => {
    const gateway = await Gateway.start(...flags);
    t.after(() => gateway.stop());
    await bring_client(page, gateway.url);
    const came = await page.evaluate(async () => {
      const { connect, Navigation, component_type, distance }: typeof import('rois-client') = await import(`${location.origin}/dist/browser.js`);
      const client = await connect(undefined, { token: 'a secret' });
      const documents: string[] = [];
      client.on('document', ({ direction, text }) => documents.push(`${direction} ${text.slice(0, 30)}`));
      const navigation = await Navigation.bind_any(client);
      const targets = await navigation.subscribe('reached_target');
      const status = String(await navigation.go_to({ x: 6500, y: 6000, th: 0 }));
      const event = await targets.next(5000);
      const profile = await client.get_profile(component_type('Move').sorted_by(distance('location', 'desk')));
      const fault = await client.send('<bind').then((answer) => answer.attribute('code'));
      const too_large = await client.bind('x'.repeat(2_000_000)).catch((error) => [error.fault.code, error.message.includes('1009')]);
      const refusal = await client.bind('elevator').catch((error) => [error.name, error.failure, error.return_code]);
      await client.close();
      return { status, target: event?.results.text('target'), components: profile.components, fault, too_large, refusal, state: client.state, first: documents[0] };
    });
    assert.deepEqual(came, {
      status: 'OK',
      target: '6500, 6000, 0',
      components: [{ ref: 'move', type: 'urn:x-rois:def:component:OMG::Move', engine: 'robot1' }],
      fault: 'not_well_formed',
      too_large: ['too_large', true],
      refusal: ['RoisError', 'refused', 'BAD_PARAMETER'],
      state: 'closed',
      first: 'out <bind_any xmlns="urn:x-rois:ps',
    });
  }));

test("the error does not mention origins when the page's own server does not answer", () =>
  in_chromium(async (page) => {
    const error = await page.evaluate(async () => {
      const { connect } = await import('rois-client');
      return connect(undefined, { deadline: 500 }).then(String, String); // the page's server does not speak WebSocket
    });
    assert.match(error, /^RoisError: no session within 500 ms: the WebSocket to ws:\/\/\S+ could not be opened; the browser's console may say why$/);
  }));

test("a page of another origin needs the gateway's permission", (t) =>
  in_chromium(async (page) => {
    const try_it = (url: string, deadline: number) =>
      page.evaluate(async ([to, within]) => {
        const { connect } = await import('rois-client');
        return connect(to, { deadline: within, first_delay: 50 }).then(
          async (client) => {
            await client.close();
            return 'welcome';
          },
          (error: { failure: string; message: string }) => `${error.failure}: ${error.message}`,
        );
      }, [url, deadline] as const);
    const closed = await Gateway.start(...flags);
    t.after(() => closed.stop());
    const { origin } = new URL(page.url());
    const refusal = await try_it(closed.url, 1000);
    assert.match(refusal, /^unreachable: /);
    assert.ok(refusal.includes(closed.url.replace('http', 'ws')), refusal);
    assert.ok(refusal.endsWith(`it may refuse pages of ${origin}: RoIS Gateway allows them with --allowed-origins ${origin}`), refusal);
    const open = await Gateway.start(...flags, '--allowed-origins', origin);
    t.after(() => open.stop());
    assert.equal(await try_it(open.url, 30_000), 'welcome');
  }));
