// A link that breaks again and again under a steady stream of events loses nothing, with the clients' default delays. A session keeps
// 1,024 notifications, so growing delays would lose some.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import { command, connect, type Gap } from 'rois-client';

import { Gateway, root } from '../kit/gateway.js';
import { output_of } from '../kit/program.js';
import { Proxy } from '../kit/proxy.js';

const [rounds, each] = [120, 25];

/** Runs the listener behind a proxy that cuts every 100 kB, while another session causes 250 events a second without the proxy. */
async function behind_a_flaky_link<T>(listen: (proxy: Proxy, begin: () => void) => Promise<T>): Promise<T> {
  const gateway = await Gateway.start('--scenario', `${root}/tests/server/data/empty_hall.xml`, '--sim-speed', '100');
  const proxy = await Proxy.before(gateway.port);
  proxy.next_cut = () => 100_000;
  proxy.cut_after_next();
  const driver = await connect(gateway.url);
  await driver.bind('navigation');
  const targets = Array.from({ length: each }, () => '4000, 5000'); // the robot's present position
  const drive = async () => {
    for (let [round, next] = [0, performance.now()]; round < rounds; ++round, next += 100) {
      assert.equal(await (await driver.execute([command('navigation', 'start', { target_position: targets })])).status(), 'OK');
      await new Promise((resolve) => setTimeout(resolve, next - performance.now()));
    }
  };
  let driving: Promise<void> | undefined;
  try {
    const outcome = await listen(proxy, () => (driving = drive()));
    await driving;
    assert.ok(proxy.cuts > 10, `${proxy.cuts} cuts`);
    return outcome;
  } finally {
    await driver.close();
    await proxy.stop();
    await gateway.stop();
  }
}

test('TypeScript receives all events, each once', () =>
  behind_a_flaky_link(async (proxy, begin) => {
    const client = await connect(proxy.url);
    try {
      const gaps: Gap[] = [];
      client.on('gap', (gap) => gaps.push(gap));
      const reached = await client.subscribe('reached_target');
      begin();
      for (let sequence = 1; sequence <= rounds * each; ++sequence) assert.equal((await reached.next(20_000))?.sequence, sequence);
      assert.deepEqual(gaps, []);
    } finally {
      await client.close();
    }
  }));

test('Python receives all events, each once', () =>
  behind_a_flaky_link(async (proxy, begin) => {
    const program = `import os, sys; sys.path.insert(0, sys.argv[1]); from rois import Engine
with Engine(os.environ["ROIS_URL"]) as engine:
    engine.subscribe("reached_target")
    print("ready", file=sys.stderr, flush=True)
    received = sum(engine.event("reached_target", 20) is not None for _ in range(${rounds * each}))
    print(received, engine.after, engine.lost + engine.dropped)`;
    const output = await output_of(['python3', '-c', program, `${root}/docs/examples`], proxy.url, {}, (text) => text.includes('ready') && begin());
    assert.equal(output, `${rounds * each} ${rounds * each} 0\n`);
  }));
