// The shell example under cuts: misses nothing without a gap, receives nothing twice, executes nothing twice. It is slow: one fork per
// field and a second's pause after each cut. ROIS_ENDURANCE=full runs the full test, which takes some minutes.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { Gateway, root } from '../kit/gateway.js';
import { output_of } from '../kit/program.js';
import { Proxy, random_from } from '../kit/proxy.js';

const { commands, cuts } = process.env['ROIS_ENDURANCE'] === 'full' ? { commands: 500, cuts: 100 } : { commands: 25, cuts: 5 };

test(`${commands * 20} events and ${commands} commands in a shell, cut ${cuts} times`, async () => {
  const gateway = await Gateway.start('--scenario', `${root}/tests/server/data/empty_hall.xml`, '--sim-speed', '100');
  const proxy = await Proxy.before(gateway.port);
  try {
    proxy.cut_at_random(cuts, 40_000, random_from(13));
    const came = JSON.parse(await output_of(['sh', `${root}/tests/clients/endurance.sh`, `${commands}`], proxy.url));
    assert.equal(proxy.cuts, cuts);
    assert.deepEqual(came, {
      good: commands,
      events: commands * 20,
      out_of_order: 0,
      completed: commands,
      completed_twice: 0,
      twice: 0,
      missed: 0,
      lost: 0,
    });
  } finally {
    await proxy.stop();
    await gateway.stop();
  }
});
