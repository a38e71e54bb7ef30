// Measures the console in Chromium with the real gateway; prints a line of JSON for each row of `./dev bench console`:
//   first view: ms until something is painted and until the map is shown, KiB transferred, and KiB of all files;
//   20 people at 20 Hz: frames per second, longest time between two (ms), share of a core used by the page's thread;
//   at rest: share of a core used by all threads of the page's process and the GPU process, with two robots and three standing people and
// each of these panels in front.
// cd web/console && npm run build && ROIS_BINARY_DIR=../../build/release npx vite-node tests/measure/console.ts [SECONDS [PANEL...]]
import { execFileSync } from 'node:child_process';
import { existsSync, readdirSync } from 'node:fs';

import { type Browser, chromium } from 'playwright-core';
import { command, connect, value } from 'rois-client';

import { Gateway, root } from '../../../client/tests/kit/gateway.js';

const people = 20;
const seconds = Number(process.argv[2] ?? 8);
const panels = process.argv.length > 3 ? process.argv.slice(3) : ['map'];
const here = `${root}/web/console/tests/measure`;
const size = { width: 1600, height: 900 };
const things = '.map table tbody tr'; // the things on the map

const gateway = await Gateway.start('--floor-plan', `${here}/crowd_hall.xml`, '--scenario', `${here}/crowd.xml`, '--sim-speed', '0', '--steering', 'on', '--seed', '7');
const browser = await chromium.launch({ executablePath: process.env['CHROMIUM'] ?? '/usr/bin/chromium', args: ['--disable-dev-shm-usage'] });
try {
  await view(browser, 'about:blank'); // the browser's own start
  console.log(JSON.stringify({ row: 'first view', ...(await view(browser, gateway.url)), all_kib: kib(weight(`${root}/web/console/dist`)) }));
  console.log(JSON.stringify({ row: `${people} people at 20 Hz`, ...(await crowd(browser)) }));
} finally {
  await browser.close();
  await gateway.stop();
}
for (const panel of panels) console.log(JSON.stringify({ row: panel === 'map' ? 'at rest' : `at rest, ${panel}`, ...(await rest(panel)) }));

/** With an empty cache. */
async function view(browser: Browser, url: string) {
  const context = await browser.newContext({ viewport: size });
  try {
    const page = await context.newPage();
    await page.addInitScript((things) => {
      const look = () => {
        if (document.querySelector(things)) performance.mark('stands');
        else requestAnimationFrame(look);
      };
      look();
    }, things);
    await page.goto(url);
    if (url === 'about:blank') return undefined;
    await page.locator(things).first().waitFor({ state: 'attached' });
    const [painted, stands, bytes] = await page.evaluate(() => [
      performance.getEntriesByName('first-contentful-paint')[0]!.startTime,
      performance.getEntriesByName('stands')[0]!.startTime,
      [...performance.getEntriesByType('navigation'), ...performance.getEntriesByType('resource')].reduce((sum, one) => sum + (one as PerformanceResourceTiming).transferSize, 0),
    ] as const);
    return { painted_ms: Math.round(painted), stands_ms: Math.round(stands), fetched_kib: kib(bytes) };
  } finally {
    await context.close();
  }
}

/** All people wander and are reported 20 times a second. */
async function crowd(browser: Browser) {
  const hall = await connect(gateway.url);
  await hall.bind('simulated_hall');
  const pass = async (ms: number) => (await hall.execute([command('simulated_hall', 'let_pass', { time: value.int(ms) })])).status();
  await pass(120_000);
  await hall.bind('person_localization');
  await (await hall.execute([command('person_localization', 'start', { detection_threshold: value.int(125), minimum_interval: value.int(50) })])).status();
  const context = await browser.newContext({ viewport: size, reducedMotion: 'no-preference' });
  try {
    const page = await context.newPage();
    let events = 0;
    page.on('websocket', (socket) => socket.on('framereceived', ({ payload }) => (events += Number(/<receive_event\b[^]*person_localized/.test(String(payload))))));
    await page.goto(gateway.url);
    await page.locator(things).first().waitFor({ state: 'attached' });

    // Simulated time: 60 ms, after which there are new reports, in 50 ms of real time.
    let is_over = false;
    const clock = (async () => {
      const began = Date.now();
      for (let passed_ms = 60; !is_over; passed_ms += 60) {
        await pass(60);
        await new Promise((passed) => setTimeout(passed, Math.max(0, (passed_ms * 50) / 60 - (Date.now() - began))));
      }
    })();
    await page.locator(things).nth(people).waitFor({ state: 'attached' });
    const inside = await page.context().newCDPSession(page);
    await inside.send('Performance.enable', { timeDomain: 'threadTicks' }); // excludes waiting
    const busy = async () => (await inside.send('Performance.getMetrics')).metrics.find(({ name }) => name === 'TaskDuration')!.value;
    const [busy_before, events_before, began] = [await busy(), events, Date.now()];
    const frames = await page.evaluate(
      (ms) =>
        new Promise<{ a_second: number; longest: number }>((done) => {
          let [first, last, count, longest] = [0, 0, 0, 0];
          const frame = (at: number) => {
            if (first === 0) first = at;
            else {
              count += 1;
              longest = Math.max(longest, at - last);
            }
            last = at;
            if (at - first < ms) requestAnimationFrame(frame);
            else done({ a_second: (count * 1000) / (at - first), longest });
          };
          requestAnimationFrame(frame);
        }),
      seconds * 1000,
    );
    const took = (Date.now() - began) / 1000;
    const share = ((await busy()) - busy_before) / took;
    is_over = true;
    await clock;
    return {
      pictures_per_second: Number(frames.a_second.toFixed(1)),
      longest_ms: Number(frames.longest.toFixed(1)),
      page_percent: Math.round(100 * share),
      events_per_second: Number(((events - events_before) / took).toFixed(1)),
    };
  } finally {
    await context.close();
    await hall.close();
  }
}

/** A separate browser that is not instrumented, except for its processes' CPU time. */
async function rest(panel: string) {
  const hall = await Gateway.start('--scenario', `${here}/rest.xml`, '--floor-plan', `${root}/components/simulation/data/two-robots.xml`, '--steering', 'on', '--seed', '7');
  const sensing = await connect(hall.url);
  for (const ref of ['person_detection', 'person_localization', 'person_identification', 'face_localization', 'sound_localization']) {
    await sensing.bind(ref);
    await (await sensing.execute([command(ref, 'start')])).status();
  }
  const window = await chromium.launch({ executablePath: process.env['CHROMIUM'] ?? '/usr/bin/chromium', args: ['--disable-dev-shm-usage'] });
  try {
    const page = await window.newPage({ viewport: size, reducedMotion: 'no-preference' });
    await page.goto(`${hall.url}/#${panel}`);
    await new Promise((passed) => setTimeout(passed, 40_000)); // all people have arrived and stand
    const inside = await window.newBrowserCDPSession();
    const taken = async () => {
      const sums = { renderer: 0, GPU: 0 };
      for (const { type, cpuTime } of (await inside.send('SystemInfo.getProcessInfo')).processInfo) if (type === 'renderer' || type === 'GPU') sums[type] += cpuTime;
      return sums;
    };
    const [before, began] = [await taken(), Date.now()];
    await new Promise((passed) => setTimeout(passed, 25_000));
    const [after, took] = [await taken(), (Date.now() - began) / 1000];
    const percent = (type: 'renderer' | 'GPU') => Number(((100 * (after[type] - before[type])) / took).toFixed(1));
    return { page_percent: percent('renderer'), gpu_percent: percent('GPU') };
  } finally {
    await window.close();
    await sensing.close();
    await hall.stop();
  }
}

function weight(folder: string): number {
  if (!existsSync(folder)) throw new Error('the console is not built: npm run build in web/console');
  return readdirSync(folder, { withFileTypes: true }).reduce((sum, one) => {
    const path = `${folder}/${one.name}`;
    return sum + (one.isDirectory() ? weight(path) : execFileSync('gzip', ['-9nc', path]).length);
  }, 0);
}

function kib(bytes: number): number {
  return Number((bytes / 1024).toFixed(1));
}
