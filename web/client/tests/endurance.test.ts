// Done when (issue 5): while the link is cut 100 times at random during 10,000 events and 500 commands, no event is missed unreported,
// none comes twice, every command completes once.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { connect } from 'rois-client';

import { commands, endure, type Endured, events_each } from './endurance.js';
import { Gateway, root } from './gateway.js';
import { in_chromium } from './page.js';
import { Proxy, random_from } from './proxy.js';

async function cut_a_hundred_times(endured_at: (url: string, gateway: Gateway) => Promise<Endured>, flags: string[] = []): Promise<void> {
  const gateway = await Gateway.start('--scenario', `${root}/tests/server/data/empty_hall.xml`, '--sim-speed', '100', ...flags);
  const proxy = await Proxy.before(gateway.port);
  try {
    proxy.cut_at_random(100, 50_000, random_from(7));
    const endured = await endured_at(proxy.url, gateway);
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
    assert.ok(resumed > 50, `${resumed}: a link that is cut before it was resumed is not`);
  } finally {
    await proxy.stop();
    await gateway.stop();
  }
}

test('in Node', () => cut_a_hundred_times((url) => endure(connect, url)));

test('in Chromium', () =>
  in_chromium(async (page) => {
    await cut_a_hundred_times(
      (url) =>
        page.evaluate(async (to) => {
          const [{ endure: run }, { connect: to_connect }] = await Promise.all([import(`${location.origin}/tests/endurance.js`), import('rois-client')]);
          return run(to_connect, to) as Promise<Endured>;
        }, url),
      ['--allowed-origins', new URL(page.url()).origin],
    );
  }));
