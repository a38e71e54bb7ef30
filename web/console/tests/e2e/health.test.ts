// The Health panel: numbers, plots, sessions, limits, error log, and accessibility.
import type { Page } from 'playwright-core';
import { connect, type Client } from 'rois-client';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';

import type { Console } from '../../src/state/console';
import { Hall } from './hall';
import { broken_link, looks, picture, root, sizes, Stage, violations } from './harness';

let stage: Stage;
const wide = { width: 1600, height: 1000 };

beforeAll(async () => {
  stage = await Stage.set('--scenario', `${root}/tests/server/data/unwell.xml`, '--sim-speed', '0', '--seed', '7', '--max-sessions', '3');
  const hall = await Hall.of(stage);
  await hall.pass(1000);
  await hall.close();
});
afterAll(() => stage.strike());

type Page_ = Window & { rois: Console };
const figure = (page: Page, name: string) => page.locator('.health-figures > div').filter({ has: page.getByText(name, { exact: true }) });
const plot = (page: Page, name: RegExp) => page.locator('.health-plot').filter({ has: page.getByRole('heading', { name }) });
const table = (page: Page, name: string) => page.getByRole('region', { name, exact: true });
const row = (page: Page, name: string, text: RegExp) => table(page, name).locator('tbody tr').filter({ hasText: text });
const log = (page: Page) => page.locator('.health-log li');

/** Another application with a binding. */
async function with_other(act: (other: Client) => Promise<void>): Promise<void> {
  const other = await connect(stage.gateway.url);
  try {
    await other.bind('follow');
    await other.bind('move');
    await act(other);
  } finally {
    await other.close();
  }
}

describe('health', () => {
  test('shows the state of link and gateway, in numbers and plots', () =>
    stage.page(
      async (page) => {
        await figure(page, 'Link').getByText('Connected').waitFor();
        for (const [name, text] of [['Round trip', /\d ms/], ['Requests', /\d \/s/], ['Sessions', /^1$/], ['Components', /^16$/], ['Memory', /MiB/], ['Processor', /\d %/], ['Open files', /\d/]] as const)
          await figure(page, name).locator('dd').getByText(text).waitFor();
        const latency = plot(page, /^Response time/);
        await latency.locator('.health-legend li').filter({ hasText: /In the gateway\s*[\d.]+ ms/ }).waitFor();
        await page.getByText(/^Slowest in the last minute: \w+/).waitFor();
        await plot(page, /^The gateway/).locator('.health-legend li').filter({ hasText: /Requests\s*[1-9][\d.]* \/s/ }).waitFor();
        await plot(page, /^This console/).locator('.health-legend li').filter({ hasText: /Received\s*[1-9][\d.]* \/s/ }).waitFor();
        // The lines are drawn once a second, not with each answer.
        const drawn = await page.locator('.health-plot canvas').first().evaluate(async (canvas: HTMLCanvasElement) => {
          const pen = canvas.getContext('2d')!;
          let n = 0;
          const clear = pen.clearRect.bind(pen);
          pen.clearRect = (...box) => ((n += 1), clear(...box));
          await new Promise((passed) => setTimeout(passed, 4000));
          return n;
        });
        expect(drawn).toBeLessThanOrEqual(5);
        expect(drawn).toBeGreaterThan(1);
        // Also as a table and by keys.
        await latency.getByText('As a table').click();
        await expect.poll(() => table(page, 'Response time, ms: values').locator('tbody tr').first().innerText()).toMatch(/^[\d:]+\s+[\d.]+ ms\s+[\d.]+ ms/);
        const slider = latency.getByRole('slider');
        await slider.focus();
        await page.keyboard.press('ArrowLeft');
        await page.keyboard.press('ArrowLeft');
        expect(await slider.getAttribute('aria-valuetext')).toMatch(/^[\d:]+: Round trip [\d.]+ ms, Slowest [\d.]+ ms/);
        expect(Number(await slider.getAttribute('aria-valuenow'))).toBeLessThan(0);
        expect(await violations(page)).toBe('');
      },
      wide,
      '/#health',
    ));

  test('shows bindings and reached limits', () =>
    stage.page(
      (page) =>
        with_other(async () => {
          await figure(page, 'Link').getByText('Connected').waitFor();
          await page.evaluate(() => (window as unknown as Page_).rois.bindings.bind('navigation'));
          await row(page, 'Sessions', /this console.*navigation/).waitFor();
          await row(page, 'Sessions', /follow.*move/).waitFor();
          await row(page, 'Limits', /^Sessions23never$/).waitFor();
          const third = await connect(stage.gateway.url);
          const refused = await fetch(`${stage.gateway.url}/rois`, { method: 'POST', headers: { 'Content-Type': 'application/xml' }, body: '<connect xmlns="urn:x-rois:psm:xml:message:1"/>' });
          expect(refused.status).toBe(429);
          await row(page, 'Limits', /^Sessions33/).waitFor();
          await row(page, 'Limits', /^Sessions331 time 1 lately$/).waitFor();
          await row(page, 'Problems since the gateway started', /too_many11$/).waitFor();
          await third.close();
          await row(page, 'Limits', /^Sessions23/).waitFor();
          expect(await violations(page)).toBe('');
          await picture(page, 'health-sessions');
        }),
      wide,
      '/#health',
    ));

  test('has a log of errors with details and of refusals', () =>
    stage.page(
      (page) =>
        with_other(async () => {
          await figure(page, 'Link').getByText('Connected').waitFor();
          await page.getByText('No errors in this session.').waitFor();
          await page.evaluate(async () => {
            const { rois } = window as unknown as Page_;
            await rois.bindings.bind('move').catch(() => undefined);
          });
          const hall = await Hall.of(stage);
          expect(await hall.run(page, 'navigation', 'start', { target_position: ['desk'] })).toBe('ERROR');
          await hall.close();
          const error = log(page).filter({ hasText: /COMPONENT_INTERNAL_ERROR\s*navigation/ }).first();
          await error.locator('summary').click();
          await error.getByRole('region', { name: /^Details/ }).getByText('component_ref').waitFor();
          await error.getByRole('region', { name: /^The document/ }).getByText('receive_error').first().waitFor();
          const refused = log(page).filter({ hasText: 'bind: OUT_OF_RESOURCES' });
          await refused.getByText(/bound by another session/).first().waitFor();
          await refused.locator('summary').click();
          expect(await violations(page)).toBe('');
          await log(page).first().scrollIntoViewIfNeeded();
          await picture(page, 'health-log');
          await refused.getByRole('button', { name: 'Show in messages' }).click();
          const chosen = page.locator('.panel-messages').getByRole('option', { selected: true }).getByText('bind').first();
          await chosen.waitFor();
          // The same document again, while the filter hides it.
          await page.getByLabel('Search in the text').fill('nothing has this text');
          await page.getByText('No document matches the filter').waitFor();
          await refused.getByRole('button', { name: 'Show in messages' }).click();
          await chosen.waitFor();
          expect(await page.getByLabel('Search in the text').inputValue()).toBe('');
        }),
      wide,
      '/#health',
    ));

  test('shows when the link was lost, and which values are unknown', () =>
    stage.page(
      async (page) => {
        await figure(page, 'Round trip').getByText(/ms$/).waitFor();
        stage.front.cut();
        await figure(page, 'Link').getByText('Connection lost').waitFor();
        const outdated = page.getByText(/^The gateway's metrics are (.* old|not available)/); // depends on whether a request failed
        await outdated.waitFor();
        await figure(page, 'Round trip').getByText('–').waitFor();
        expect(await violations(page)).toBe('');
        await picture(page, 'health-lost');
        stage.front.restore();
        await figure(page, 'Link').getByText('Connected again').waitFor();
        await log(page).filter({ hasText: 'Connection lost' }).waitFor();
        await outdated.waitFor({ state: 'detached' });
      },
      { ...wide, may_complain: broken_link },
      '/#health',
    ));

  test.each(looks)('looks well and is accessible: %s, %s, %s', (size, look, language) =>
    stage.page(
      (page) =>
        with_other(async () => {
          await page.locator('.health-legend strong').first().getByText(/\d/).waitFor();
          await page.getByText('follow', { exact: true }).last().waitFor();
          expect(await violations(page)).toBe('');
          await picture(page, `health-${size}-${look}-${language}`);
        }),
      { ...sizes[size], look, language, touch: size !== 'wide' },
      '/#health',
    ),
  );
});
