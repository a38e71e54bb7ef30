// The time line: content, pointer and keys, going back in time, and accessibility.
import type { Page } from 'playwright-core';
import { command, connect, value } from 'rois-client';
import { describe, expect, test } from 'vitest';

import type { Console } from '../../src/state/console';
import { type Hall, set_still_hall } from './hall';
import { broken_link, looks, picture, sizes, type Stage, violations } from './harness';

let stage: Stage;
let hall: Hall;
const wide = { width: 1600, height: 1000 };

set_still_hall(async (...both) => {
  [stage, hall] = both;
  await hall.pass(1000);
});

type Page_ = Window & { rois: Console };
const lane = (page: Page, name: string) => page.locator('.timeline-name', { hasText: new RegExp(`^${name}$`) });
const rows = (page: Page, text: RegExp) => page.locator('.timeline-listing tbody tr').filter({ hasText: text });
const details = (page: Page) => page.getByRole('region', { name: 'Details', exact: true });

/** Two commands on the way to the desk, one of which fails; another session has bound `follow`. */
async function day(page: Page): Promise<void> {
  await lane(page, 'navigation').waitFor();
  await page.evaluate(() => (window as unknown as Page_).rois.subscribe('person_detected', { inline_results: true }).then(() => undefined));
  await hall.run(page, 'person_detection', 'start');
  await hall.run(page, 'speech_synthesis', 'start', { speech_text: 'Welcome.' });
  await hall.run(page, 'navigation', 'start', { target_position: ['desk'] });
  await hall.run(page, 'navigation', 'start', { target_position: ['100000, 4'] });
}

/** The position of a time in a lane; time is stopped. */
async function point(page: Page, name: string, at: number, below = 0.8): Promise<{ x: number; y: number }> {
  await lane(page, name).scrollIntoViewIfNeeded();
  const label = (await lane(page, name).boundingBox())!;
  const canvas = page.locator('.timeline-canvas');
  const box = (await canvas.boundingBox())!;
  const { from, to } = await canvas.evaluate(({ dataset }) => ({ from: Number(dataset['from']), to: Number(dataset['to']) }));
  return { x: box.x + ((at - from) / (to - from)) * box.width, y: label.y + label.height * below };
}
const sent_at = (page: Page, index: number) => page.evaluate((i) => (window as unknown as Page_).rois.commands.all.at(i)!.sent_at, index);
const middle_of = (page: Page, index: number) =>
  page.evaluate((i) => {
    const { sent_at: from, ended_at: to } = (window as unknown as Page_).rois.commands.all.at(i)!;
    return (from + to!) / 2;
  }, index);
const ended_at = (page: Page, index: number) => page.evaluate((i) => (window as unknown as Page_).rois.commands.all.at(i)!.ended_at!, index);
async function stop_time(page: Page): Promise<void> {
  await page.getByRole('button', { name: 'Stop time' }).click();
  await page.getByText('Stopped', { exact: true }).waitFor();
  await drawn(page);
}
/** A click is drawn a frame later. */
const drawn = (page: Page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
/** Selects a range by dragging. */
async function zoom(page: Page, from: number, to: number): Promise<void> {
  const [begin, end] = [await point(page, 'navigation', from), await point(page, 'navigation', to)];
  await page.mouse.move(begin.x, begin.y);
  await page.mouse.down();
  await page.mouse.move((begin.x + end.x) / 2, begin.y);
  await page.mouse.move(end.x, end.y);
  await page.mouse.up();
  await expect.poll(async () => Math.abs((await span(page)) - (to - from))).toBeLessThan(300);
}
const span = (page: Page) => page.locator('.timeline-canvas').evaluate(({ dataset }) => Number(dataset['to']) - Number(dataset['from']));

describe('the time line', () => {
  test('shows the link, components, owners, commands and events, also as a table', () =>
    stage.page(
      async (page) => {
        const other = await connect(stage.gateway.url);
        await other.bind('follow');
        await day(page);
        await page.getByLabel('As a table').check();
        await rows(page, /Link Connected/).first().waitFor();
        await rows(page, /Status READYnavigation/).first().waitFor();
        await rows(page, /Status BUSYfollow/).first().waitFor();
        await rows(page, /Bound by this consolenavigation/).first().waitFor();
        await rows(page, /Bound by session \d+follow/).first().waitFor();
        await rows(page, /Command startspeech_synthesisOK/).waitFor();
        await rows(page, /Command startnavigationOK/).waitFor();
        await rows(page, /Command startnavigationERROR/).waitFor();
        await rows(page, /Event person_detectedperson_detection/).first().waitFor();
        await page.evaluate(() => (window as unknown as Page_).rois.run('speech_synthesis', 'start', { speech_text: 'Hello.', volume: 500 }).catch(() => undefined));
        await rows(page, /Refused executespeech_synthesisBAD_PARAMETER/).waitFor();
        expect(await violations(page)).toBe('');
        await picture(page, 'timeline-table');
        // One runs, and one waits for it.
        const units = [command('navigation', 'start', { target_position: value.strings(['exit']) }), command('speech_synthesis', 'start', { speech_text: 'Here we are.' })];
        await page.evaluate((those) => (window as unknown as Page_).rois.execute(those).then(() => undefined), units);
        await rows(page, /Command startnavigationrunning/).waitFor();
        await rows(page, /Command startspeech_synthesiswaiting/).waitFor();
        await page.getByRole('button', { name: 'Stop time' }).click();
        await rows(page, /Command startnavigationERROR/).getByRole('button').click();
        await details(page).getByText('The component failed.').waitFor();
        await other.close();
      },
      wide,
      '/#timeline',
    ));

  test("hides events of the console's own subscriptions until requested", () =>
    stage.page(
      async (page) => {
        await page.getByLabel('As a table').check();
        await rows(page, /Status READYnavigation/).first().waitFor();
        await hall.run(page, 'person_detection', 'stop');
        await hall.run(page, 'person_detection', 'start');
        await hall.pass(1000);
        await rows(page, /Command startperson_detectionOK/).waitFor();
        expect(await rows(page, /Event person_detected/).count()).toBe(0);
        await page.getByLabel('Console’s own events').check();
        await rows(page, /Event person_detectedperson_detection/).first().waitFor();
        await page.getByLabel('Hide quiet components').check();
        await rows(page, /Status READYnavigation/).first().waitFor({ state: 'detached' });
      },
      wide,
      '/#timeline',
    ));

  test('shows values under the pointer, and opens the clicked thing', () =>
    stage.page(
      async (page) => {
        await day(page);
        await page.getByLabel('Time range').selectOption('10 s');
        await expect.poll(() => span(page)).toBe(10_000);
        await page.getByLabel('Time range').selectOption('1 min');
        await stop_time(page);
        await zoom(page, (await sent_at(page, -2)) - 1500, (await ended_at(page, -1)) + 100); // time was stopped later
        const walk = await point(page, 'navigation', await middle_of(page, -2));
        await page.mouse.move(walk.x, walk.y);
        const tip = page.locator('.timeline-tip');
        await tip.getByText('navigation').waitFor();
        expect(await tip.innerText()).toMatch(/Command start[^]*OK[^]*Sent[^]*Ran/);
        await zoom(page, (await sent_at(page, -1)) - 100, (await ended_at(page, -1)) + 50); // it failed at once
        const failed = await point(page, 'navigation', await middle_of(page, -1));
        await page.mouse.move(failed.x, failed.y);
        await tip.getByText(/100000, 4 is outside the map/).waitFor();
        await page.mouse.click(failed.x, failed.y);
        await details(page).getByText('The component failed.').waitFor();
        await details(page).getByRole('region', { name: 'Arguments' }).getByText('100000, 4').waitFor();
        await details(page).getByText('The request').click();
        expect(await details(page).getByRole('region', { name: 'The request' }).textContent()).toContain('100000, 4');
        expect(await violations(page)).toBe('');
        await picture(page, 'timeline-details');
        await details(page).getByRole('button', { name: 'Show in messages' }).click();
        await page.locator('.panel-messages').getByRole('option', { selected: true }).getByText('execute').waitFor();
      },
      wide,
      '/#timeline',
    ));

  test('is operated by keyboard alone', () =>
    stage.page(
      async (page) => {
        await day(page);
        const chart = page.getByRole('application', { name: /^Time line of/ });
        const announced = page.locator('.timeline-frame [role=status]');
        await chart.focus();
        await page.keyboard.press('ArrowDown');
        await page.getByText('Stopped', { exact: true }).waitFor();
        await page.keyboard.press('ArrowDown');
        await announced.getByText(/^Command, start/).waitFor({ state: 'attached' });
        for (let i = 0; i < 6; ++i) await page.keyboard.press('ArrowRight');
        await announced.getByText(/^Command, start, navigation, ERROR, Sent .* Ran /).waitFor({ state: 'attached' });
        await page.locator('.timeline-tip').getByText('ERROR').waitFor();
        await page.keyboard.press('Enter');
        await details(page).getByText('The component failed.').waitFor();
        await page.keyboard.press('Escape');
        await details(page).waitFor({ state: 'detached' });
        expect(await chart.evaluate((one) => one === document.activeElement)).toBe(true);
        const before = await span(page);
        await page.keyboard.press('+');
        await expect.poll(() => span(page)).toBeCloseTo(before / 1.5, 3);
        await page.keyboard.press('-');
        await page.keyboard.press('Home');
        await page.getByText('Stopped', { exact: true }).waitFor();
        await page.keyboard.press(' ');
        await page.getByText('Live', { exact: true }).waitFor();
      },
      wide,
      '/#timeline',
    ));

  test('zooms by dragging and with the wheel, goes back in time, and returns to live', () =>
    stage.page(
      async (page) => {
        await day(page);
        await stop_time(page);
        const at = await sent_at(page, 0);
        await zoom(page, at - 2000, at);
        await picture(page, 'timeline-zoomed');
        const chosen = await span(page);
        const middle = await point(page, 'navigation', at - 1000);
        const under = async () => (await point(page, 'navigation', at - 1000)).x;
        await page.mouse.move(middle.x, middle.y);
        await page.mouse.wheel(0, 200);
        await expect.poll(() => span(page)).toBeGreaterThan(chosen * 1.2);
        expect(Math.abs((await under()) - middle.x)).toBeLessThan(2); // the time under the pointer stays
        await page.getByRole('button', { name: 'Previous range' }).click();
        await expect.poll(() => span(page)).toBe(60_000);
        await page.getByRole('button', { name: 'Earlier' }).click();
        await page.getByText('Stopped', { exact: true }).waitFor();
        await drawn(page);
        // Later events are kept, and do not move the shown range.
        const still = await page.locator('.timeline-canvas').getAttribute('data-to');
        await hall.run(page, 'speech_synthesis', 'start', { speech_text: 'Good bye.' });
        expect(await page.locator('.timeline-canvas').getAttribute('data-to')).toBe(still);
        await page.getByRole('button', { name: 'Go live' }).click();
        await page.getByLabel('As a table').check();
        await expect.poll(() => rows(page, /Command startspeech_synthesisOK/).count()).toBe(2);
      },
      wide,
      '/#timeline',
    ));

  test('does not show spans through a lost link', () =>
    stage.page(
      async (page) => {
        await lane(page, 'navigation').waitFor();
        await expect.poll(() => page.evaluate(() => (window as unknown as Page_).rois.status.of('navigation')?.status)).toBe('READY');
        stage.front.cut();
        await page.getByText('Connection lost', { exact: true }).first().waitFor();
        stage.front.restore();
        await page.getByText('Connected again', { exact: true }).first().waitFor();
        await expect.poll(() => page.evaluate(() => [...(window as unknown as Page_).rois.history.past].filter((one) => one.ref === 'navigation' && one.kind === 'status').length)).toBe(1);
        await page.getByLabel('As a table').check();
        await rows(page, /Link Connection lost/).waitFor();
        await expect.poll(() => rows(page, /Status READYnavigation/).count()).toBe(2);
      },
      { ...wide, may_complain: broken_link },
      '/#timeline',
    ));

  test.each(looks)('looks well and is accessible: %s, %s, %s', (size, look, language) =>
    stage.page(
      async (page) => {
        await day(page);
        expect(await violations(page)).toBe('');
        await page.locator('.timeline-place').focus();
        await page.keyboard.press('ArrowDown');
        await page.keyboard.press('ArrowDown');
        await page.locator('.timeline-tip').waitFor();
        await picture(page, `timeline-${size}-${look}-${language}`);
      },
      { ...sizes[size], look, language, touch: size !== 'wide' },
      '/#timeline',
    ),
  );
});
