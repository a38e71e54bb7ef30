// The stop button, and how the page shows a stopped gateway and held motion.
import type { Page } from 'playwright-core';
import { clear_everything, command, connect, namespaces, stop_everything, value } from 'rois-client';
import { afterAll, afterEach, beforeAll, expect, test } from 'vitest';

import type { Console } from '../../src/state/console';
import { broken_link, is_in_view, looks, picture, root, sizes, Stage, violations } from './harness';

type Page_ = Window & { rois: Console };

let stage: Stage;

beforeAll(async () => {
  stage = await Stage.set('--scenario', `${root}/tests/server/data/empty_hall.xml`, '--sim-speed', '1', '--motion-lease', '1');
});
afterEach(async () => void (await clear_everything(stage.gateway.url)));
afterAll(() => stage.strike());

const stop = (page: Page) => page.locator('.head').getByRole('button', { name: /^STOP everything/ });
const stopped = (page: Page) => page.getByText('Everything is stopped.');
const connected = (page: Page) => page.getByText('Connected', { exact: true }).waitFor();
const walk = (page: Page) =>
  page.evaluate(async () => {
    const { rois } = window as unknown as Page_;
    const { ends } = await rois.run('navigation', 'start', { target_position: ['14000, 6000', '1000, 6000', '14000, 6000'] });
    const ended = { how: [] as string[] };
    void ends.then((how) => (ended.how = how));
    (window as unknown as { ended: typeof ended }).ended = ended;
  });

/** Whether a press on its middle would meet it. */
const is_on_top = (page: Page) =>
  page.evaluate(() => {
    const dialog = document.querySelector('dialog[open]');
    const button = (dialog ?? document.querySelector('.head')!).querySelector('[aria-label^="STOP everything"]')!;
    const { left, right, top, bottom } = button.getBoundingClientRect();
    return button.contains(document.elementFromPoint((left + right) / 2, (top + bottom) / 2)) && left >= 0 && right <= innerWidth;
  });

test.each(['wide', 'small', 'phone'] as const)('the stop button is visible with every panel, in dialogs and over the menu: %s', (size) =>
  stage.page(
    async (page) => {
      await connected(page);
      for (const name of await page.getByRole('tab').allTextContents()) {
        const tab = page.getByRole('tab', { name, exact: true });
        if ((await tab.count()) === 0) continue;
        await tab.first().click();
        expect(await is_in_view(stop(page)), name).toBe(true);
        expect(await is_on_top(page), name).toBe(true);
      }
      await page.evaluate(() => {
        const { notices } = (window as unknown as Page_).rois;
        notices.show('error', 'Something went wrong that takes a long line to be said, and some more words after it', { action: { label: 'Undo', act: () => undefined } });
      });
      expect(await is_on_top(page), 'with a notice').toBe(true);
      const menu = page.locator('.head summary');
      if ((await menu.count()) > 0) await menu.click();
      expect(await is_on_top(page), 'with the menu').toBe(true);
      await page.getByRole('button', { name: /^\d+ bound$/ }).click();
      await page.getByRole('dialog').waitFor();
      expect(await is_on_top(page), 'in a dialog').toBe(true);
      await picture(page, `stop-dialog-${size}`);
      expect(await violations(page)).toBe('');
      await page.getByRole('dialog').getByRole('button', { name: /^STOP everything/ }).click();
      await page.keyboard.press('Escape');
      await stopped(page).waitFor();
      await picture(page, `stop-notice-${size}`);
      await page.keyboard.press('Escape');
      expect(await is_in_view(stopped(page))).toBe(true);
      expect(await is_on_top(page), 'while it is stopped').toBe(true);
      expect(await violations(page)).toBe('');
      await picture(page, `stop-${size}`);
    },
    { ...sizes[size], touch: size !== 'wide' },
  ), 120_000);

test('one press stops all components, and every page shows the stop until it is cleared, also after a reload', () =>
  stage.page(async (page) => {
    await connected(page);
    await walk(page);
    await stage.page(async (other) => {
      await connected(other);
      await stop(page).click();
      await stopped(page).waitFor();
      await page.waitForFunction(() => (window as unknown as { ended: { how: string[] } }).ended.how[0] === 'ABORT');
      await stopped(other).waitFor({ timeout: 3000 });
      await other.reload();
      await stopped(other).waitFor();
      await other.getByRole('button', { name: 'Clear', exact: true }).click();
      expect(await stopped(page).isVisible(), 'it asks first').toBe(true);
      await other.getByRole('dialog').getByText('may start robots again').waitFor();
      await other.getByRole('dialog').getByRole('button', { name: 'Clear', exact: true }).click();
      await stopped(other).waitFor({ state: 'detached' });
      await stopped(page).waitFor({ state: 'detached', timeout: 5000 });
    });
    await walk(page);
  }), 60_000);

test('unconfirmed components are named until they confirm', () =>
  stage.page(async (page) => {
    await connected(page);
    let waiting = ['navigation', 'robot2.move'];
    await page.route('**/rois/stop', (route) =>
      route.fulfill({
        contentType: 'application/xml; charset=utf-8',
        body: `<stop_state xmlns="${namespaces.message}"><stopped>true</stopped>${waiting.map((ref) => `<not_halted>${ref}</not_halted>`).join('')}</stop_state>`,
      }),
    );
    await page.route('**/readyz', (route) =>
      route.fulfill({ status: 503, contentType: 'text/plain', body: `stopped: nothing starts until POST /rois/clear\n${waiting.map((ref) => `${ref} has not confirmed that it stands still\n`).join('')}` }),
    );
    await stop(page).click();
    await page.getByText('Not confirmed yet: navigation, robot2.move.').waitFor();
    await picture(page, 'stop-not-confirmed');
    waiting = ['robot2.move'];
    await page.getByText('Not confirmed yet: robot2.move.').waitFor();
    waiting = [];
    await page.getByText(/^Not confirmed yet/).waitFor({ state: 'detached' });
    expect(await stopped(page).isVisible()).toBe(true);
  }));

test.each(['wide', 'phone'] as const)('a stop works without a WebSocket, and a failed stop is reported: %s', (size) =>
  stage.page(
    async (page) => {
      await connected(page);
      stage.front.lets_requests_pass = true;
      stage.front.cut();
      await page.getByText('Connection lost', { exact: true }).waitFor();
      await stop(page).click();
      await stopped(page).waitFor();
      expect((await fetch(`${stage.gateway.url}/readyz`)).status).toBe(503);
      stage.front.lets_requests_pass = false;
      await stop(page).click();
      await page.locator('.head').getByRole('alert').getByText(/^Not stopped: /).waitFor();
      expect(await is_in_view(page.locator('.head').getByRole('alert'))).toBe(true);
      await picture(page, `stop-failed-${size}`);
      stage.front.restore();
    },
    { ...sizes[size], may_complain: broken_link },
  ));

test('the stop button is visible before there is a session', () =>
  stage.page(
    async (page) => {
      stage.front.token = 'a secret';
      await page.reload();
      const dialog = page.getByRole('dialog');
      await dialog.getByText('This gateway requires a token').waitFor();
      await dialog.getByRole('button', { name: /^STOP everything/ }).click();
      await dialog.getByRole('alert').getByText('Not stopped: status 401').waitFor();
      stage.front.token = undefined;
      await dialog.getByRole('button', { name: /^STOP everything/ }).click();
      await dialog.getByRole('alert').waitFor({ state: 'detached' });
      expect((await fetch(`${stage.gateway.url}/readyz`)).status).toBe(503);
    },
    { may_complain: broken_link },
  ));

test.each(looks)('the stop is accessible: %s, %s, %s', (size, look, language) =>
  stage.page(
    async (page) => {
      await stop_everything(stage.gateway.url);
      await page.getByRole('button', { name: /^(Clear|解除)$/ }).waitFor();
      expect(await violations(page)).toBe('');
      await picture(page, `stop-${size}-${look}-${language}`);
    },
    { ...sizes[size], look, language, touch: size !== 'wide' },
  ));

test('a held motion is shown, with a button to resume it', () =>
  stage.page(async (page) => {
    await connected(page);
    await walk(page);
    await page.evaluate(() => {
      const end = performance.now() + 2500;
      while (performance.now() < end);
    });
    await page.getByText('navigation is held.').waitFor();
    await picture(page, 'held');
    await page.getByRole('button', { name: 'Resume' }).click();
    await page.waitForTimeout(2500);
    expect(await page.getByText('navigation is held.').count()).toBe(0);
  }), 30_000);

test('the held motion of another application is shown without a button to resume it', async () => {
  const driver = await connect(stage.gateway.url);
  await driver.bind('navigation');
  await stage.page(async (page) => {
    await connected(page);
    await page.evaluate(() => (window as unknown as Page_).rois.subscribe('reached_target').then(() => undefined));
    await driver.execute([command('navigation', 'start', { target_position: value.strings(['14000, 6000', '1000, 6000', '14000, 6000']) })]);
    Atomics.wait(new Int32Array(new SharedArrayBuffer(4)), 0, 0, 2500);
    await page.getByText('navigation is held.').waitFor();
    expect(await page.getByRole('button', { name: 'Resume' }).count()).toBe(0);
  });
  await driver.close();
});
