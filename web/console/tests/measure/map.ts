// How smoothly the floor map runs: 20 people who are told of 20 times a second, by the real gateway, in Chromium. Prints one line of JSON:
//   pictures a second, the longest time between two (ms), how much of a core the page's thread works, events a second.
// cd web/console && npm run build && ROIS_BINARY_DIR=../../build/release npx vite-node tests/measure/map.ts [SECONDS]
import { connect, command, value } from 'rois-client';

import { root, Stage } from '../e2e/harness';

const people = 20;
const seconds = Number(process.argv[2] ?? 10);
const here = `${root}/web/console/tests/measure`;

const stage = await Stage.set('--floor-plan', `${here}/crowd_hall.xml`, '--scenario', `${here}/crowd.xml`, '--sim-speed', '0', '--steering', 'on', '--seed', '7');
const hall = await connect(stage.gateway.url);
await hall.bind('simulated_hall');
const pass = async (ms: number) => (await hall.execute([command('simulated_hall', 'let_pass', { time: value.int(ms) })])).status();

// Everybody has come in and strolls about.
await pass(120_000);
await hall.bind('person_localization');
await (await hall.execute([command('person_localization', 'start', { detection_threshold: value.int(0), minimum_interval: value.int(50) })])).status();

try {
  await stage.page(
    async (page) => {
      let events = 0;
      page.on('websocket', (socket) => socket.on('framereceived', ({ payload }) => (events += Number(/<receive_event\b[^]*person_localized/.test(String(payload))))));
      await page.reload();
      await page.locator('.map table tbody tr').nth(0).waitFor();

      // The world's clock: 50 ms of it in 50 ms.
      let is_over = false;
      let told = 0;
      const clock = (async () => {
        for (const began = Date.now(); !is_over; ) {
          await pass(60);
          told += 60;
          await new Promise((passed) => setTimeout(passed, Math.max(0, told * (50 / 60) - (Date.now() - began))));
        }
      })();
      await page.locator('.map table tbody tr').nth(people).waitFor({ state: 'attached' });
      const inside = await page.context().newCDPSession(page);
      await inside.send('Performance.enable', { timeDomain: 'threadTicks' }); // work, not waiting for others' work
      const busy = async () => (await inside.send('Performance.getMetrics')).metrics.find(({ name }) => name === 'TaskDuration')!.value;
      const [busy_before, events_before, began] = [await busy(), events, Date.now()];
      const frames = await page.evaluate(
        (ms) =>
          new Promise<{ count: number; longest: number; late: number }>((done) => {
            let [first, last, count, longest, late] = [0, 0, 0, 0, 0];
            const frame = (at: number) => {
              if (first === 0) first = at;
              else {
                count += 1;
                longest = Math.max(longest, at - last);
                late += Number(at - last > 25);
              }
              last = at;
              if (at - first < ms) requestAnimationFrame(frame);
              else done({ count: (count * 1000) / (at - first), longest, late });
            };
            requestAnimationFrame(frame);
          }),
        seconds * 1000,
      );
      const took = (Date.now() - began) / 1000;
      const share = ((await busy()) - busy_before) / took;
      is_over = true;
      await clock;
      console.log(
        JSON.stringify({
          people,
          frames_per_second: Number(frames.count.toFixed(1)),
          longest_frame_ms: Number(frames.longest.toFixed(1)),
          late_frames: frames.late,
          main_thread_share: Number(share.toFixed(2)),
          events_per_second: Number(((events - events_before) / took).toFixed(1)),
          seconds,
        }),
      );
    },
    { motion: 'no-preference' },
  );
} finally {
  await hall.close();
  await stage.strike();
}
