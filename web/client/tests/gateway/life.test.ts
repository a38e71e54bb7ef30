// A robot moves while the application's own thread is alive, and is held when that hangs (docs/safety.md).
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { test, type TestContext } from 'node:test';
import { setTimeout as pause } from 'node:timers/promises';

import { type Client, clear_everything, command, connect, Navigation, stop_everything, value } from 'rois-client';

import { Gateway, root } from '../kit/gateway.js';
import { bring_client, in_chromium } from '../kit/page.js';

const lease = 1000; // ms
const longer = 2500; // ms, longer than the lease plus the delays of a busy machine
const way = ['14000, 6000', '1000, 6000', '14000, 6000', '1000, 6000'];

async function hall(t: TestContext, ...flags: string[]): Promise<Gateway> {
  const gateway = await Gateway.start('--scenario', `${root}/tests/server/data/empty_hall.xml`, '--sim-speed', '1', ...flags);
  t.after(() => gateway.stop());
  return gateway;
}

/** A second session that records why navigation was held, in order. */
async function watcher(t: TestContext, gateway: Gateway): Promise<{ holds: string[]; client: Client; is_busy(): Promise<void> }> {
  const client = await connect(gateway.url);
  t.after(() => client.close());
  const holds: string[] = [];
  client.on('notification', async (notification) => {
    if (notification.name === 'receive_error') holds.push((await client.get_error_detail(notification.error_id)).text('text') ?? '');
  });
  await client.subscribe('reached_target');
  const is_busy = async () => {
    while ((await client.query('component_status', navigation_only)).results.text('status') !== 'BUSY') await pause(20);
  };
  return { holds, client, is_busy };
}

const navigation_only = { xml: '<fes:Filter><fes:PropertyIsEqualTo><fes:ValueReference>component_ref</fes:ValueReference><fes:Literal>navigation</fes:Literal></fes:PropertyIsEqualTo></fes:Filter>' };

async function set_out(client: Client): Promise<void> {
  await client.bind('navigation');
  await client.execute([command('navigation', 'start', { target_position: value.strings(way) })]);
}

const held = /^its motion is held: its application gave no sign of life/;

test('in Node, a robot moves on while the event loop runs', async (t) => {
  const gateway = await hall(t);
  const { holds } = await watcher(t, gateway);
  const client = await connect(gateway.url, { motion_lease: lease });
  t.after(() => client.close());
  await set_out(client);
  await pause(longer);
  assert.deepEqual(holds, []);
});

test('in Node, a robot is held when the event loop is blocked, and resume continues', async (t) => {
  const gateway = await hall(t);
  const { holds } = await watcher(t, gateway);
  const client = await connect(gateway.url, { motion_lease: lease });
  t.after(() => client.close());
  await set_out(client);
  const notifications = client.notifications();
  Atomics.wait(new Int32Array(new SharedArrayBuffer(4)), 0, 0, longer);
  const error = await notifications.next(10_000);
  assert.equal(error?.name === 'receive_error' && error.error_type, 'USER_DEFINED_ERROR');
  while (holds.length === 0) await pause(20);
  assert.match(holds[0] ?? '', held);
  await new Navigation(client, 'navigation').resume();
  await pause(longer);
  assert.equal(holds.length, 1);
});

// A page that has started a robot. `throttled` timers fire at most once a second, as in a hidden tab.
async function page_sets_out(t: TestContext, options: { motion_lease?: number }, throttled: boolean, act: (page: import('playwright-core').Page, holds: string[]) => Promise<void>) {
  const gateway = await hall(t);
  const { holds, is_busy } = await watcher(t, gateway);
  await in_chromium(async (page) => {
    await bring_client(page, gateway.url);
    await page.evaluate(
      async ([options, way, throttled]) => {
        const usual = setInterval;
        if (throttled) window.setInterval = ((again: () => void, ms: number) => usual(again, Math.max(1000, ms))) as typeof setInterval;
        const { connect, command, value }: typeof import('rois-client') = await import(`${location.origin}/dist/browser.js`);
        const client = await connect(undefined, options);
        await client.bind('navigation');
        await client.execute([command('navigation', 'start', { target_position: value.strings(way) })]);
      },
      [options, way, throttled] as const,
    );
    await is_busy();
    await act(page, holds);
  });
}

test('in a browser, a robot moves on while the page is alive', (t) =>
  page_sets_out(t, { motion_lease: lease }, false, async (_, holds) => {
    await pause(longer);
    assert.deepEqual(holds, []);
  }));

test('in a browser, a robot moves on with the timers of a hidden page', (t) =>
  page_sets_out(t, {}, true, async (_, holds) => {
    await pause(4500);
    assert.deepEqual(holds, []);
  }));

test('in a browser, a robot is held when the page hangs, although the browser answers pings', (t) =>
  page_sets_out(t, { motion_lease: lease }, false, async (page, holds) => {
    await page.evaluate((ms) => {
      const end = performance.now() + ms;
      while (performance.now() < end);
    }, longer);
    assert.match(holds[0] ?? '', held);
  }));

test("a lease above the gateway's is refused at once", async (t) => {
  const gateway = await hall(t);
  await assert.rejects(connect(gateway.url, { motion_lease: 3000 }), /unreachable|motion_lease must be 1000 to 2000 milliseconds, not 3000/);
});

// --- Python ---

const python = `
import sys; sys.path.insert(0, "${root}/docs/examples")
from rois import Engine
with Engine(sys.argv[1], motion_lease=${lease / 1000}) as engine:
    engine.bind("navigation")
    engine.run("navigation", target_position=("string[]", ${way.map((one) => JSON.stringify(one)).join(', ')}))
`;

test('in Python, a robot moves on while the program waits, and is held when the program is stopped', async (t) => {
  const gateway = await hall(t);
  const { holds, is_busy } = await watcher(t, gateway);
  const program = spawn('python3', ['-c', python, gateway.url], { stdio: ['ignore', 'inherit', 'inherit'], env: { ...process.env, PYTHONDONTWRITEBYTECODE: '1' } });
  const ended = once(program, 'exit');
  t.after(() => program.kill('SIGKILL') && ended);
  await is_busy();
  await pause(longer);
  assert.deepEqual(holds, []);
  program.kill('SIGSTOP');
  await pause(longer + 1000);
  assert.match(holds[0] ?? '', held);
});

// --- Stop for everything ---

test('everything is stopped and cleared without a session', async (t) => {
  const gateway = await hall(t);
  const client = await connect(gateway.url);
  t.after(() => client.close());
  await client.bind('navigation');
  const walk = await client.execute([command('navigation', 'start', { target_position: value.strings(way) })]);
  let state = await stop_everything(gateway.url);
  assert.ok(state.not_halted.every((ref) => ref === 'navigation'), state.not_halted.join());
  for (const end = Date.now() + 5000; state.not_halted.length > 0 && Date.now() < end;) state = await stop_everything(gateway.url);
  assert.deepEqual(state, { stopped: true, not_halted: [] });
  assert.equal(await walk.status(), 'ABORT');
  const refused = await client.execute([command('navigation', 'start', { target_position: value.strings(way) })]).then(
    (one) => one.completion().then(String),
    String,
  );
  assert.match(refused, /everything was stopped/);
  assert.equal((await clear_everything(gateway.url)).stopped, false);
  await client.execute([command('navigation', 'start', { target_position: value.strings(way) })]);
});

test('the components that have not confirmed are named', async (t) => {
  const gateway = await Gateway.start('--scenario', `${root}/tests/server/data/unstoppable.xml`, '--sim-speed', '0');
  t.after(() => gateway.stop());
  assert.deepEqual(await stop_everything(gateway.url), { stopped: true, not_halted: ['navigation'] });
  assert.deepEqual(await clear_everything(gateway.url), { stopped: false, not_halted: ['navigation'] });
});

test('a stop of an unreachable gateway is reported as unreachable', async () => {
  await assert.rejects(stop_everything('http://127.0.0.1:1'), { name: 'RoisError', failure: 'unreachable' });
});
