// The page as a whole: what stands where, how the link is told, themes, languages, keyboard, screen readers.
import { afterAll, beforeAll, describe, expect, test } from 'vitest';

import { picture, root, sizes, Stage, violations } from './harness';

let stage: Stage;
const lost_link = /WebSocket|Failed to load resource|ERR_/;

beforeAll(async () => {
  stage = await Stage.set('--scenario', `${root}/tests/server/data/empty_hall.xml`, '--sim-speed', '1', '--seed', '7');
});
afterAll(() => stage.strike());

describe('the page', () => {
  test('connects by itself and shows what the engine has', () =>
    stage.page(async (page) => {
      await page.getByText('Connected', { exact: true }).waitFor();
      await page.getByText('speech_synthesis', { exact: true }).waitFor();
      await page.locator('.engine-component', { hasText: 'navigation' }).getByText('READY').waitFor();
      expect(await page.title()).toBe('RoIS console');
      await picture(page, 'shell-wide-dark');
    }));

  test.each([
    ['wide', 'dark', 'en'],
    ['wide', 'light', 'ja'],
    ['tablet', 'light', 'en'],
    ['small', 'dark', 'ja'],
  ] as const)('is accessible: %s, %s, %s', (size, look, language) =>
    stage.page(
      async (page) => {
        await page.getByText('speech_synthesis', { exact: true }).waitFor();
        await page.locator('.engine-component', { hasText: 'navigation' }).getByText('READY').waitFor();
        expect(await violations(page)).toBe('');
        expect(await page.evaluate(() => document.documentElement.lang)).toBe(language);
        await picture(page, `shell-${size}-${look}-${language}`);
      },
      { ...sizes[size], look, language, touch: size !== 'wide' },
    ),
  );

  test('tells that the link is lost, what is stale, and that it is there again', () =>
    stage.page(
      async (page) => {
        await page.getByText('Connected', { exact: true }).waitFor();
        stage.front.cut();
        await page.getByText('Connection lost', { exact: true }).waitFor();
        await page.getByText(/What you see is .* old/).waitFor();
        expect(await violations(page)).toBe('');
        await picture(page, 'shell-lost');
        stage.front.mend();
        await page.getByText('Connected again', { exact: true }).waitFor();
      },
      { may_complain: lost_link },
    ));

  test('remembers colours and language', () =>
    stage.page(async (page) => {
      await page.getByLabel('Colours').selectOption('light');
      expect(await page.evaluate(() => document.documentElement.dataset['theme'])).toBe('light');
      await page.getByLabel('Language').selectOption('ja');
      await page.getByText('接続済み').waitFor();
      await page.reload();
      await page.getByText('接続済み').waitFor();
      expect(await page.evaluate(() => document.documentElement.dataset['theme'])).toBe('light');
    }));

  test('ends its session when the user says so, and begins a new one', () =>
    stage.page(async (page) => {
      await page.getByRole('button', { name: 'Disconnect' }).click();
      await page.getByText('Disconnected', { exact: true }).waitFor();
      await page.getByRole('button', { name: 'Connect', exact: true }).click();
      await page.getByText('Connected', { exact: true }).waitFor();
    }));
});
