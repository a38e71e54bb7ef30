// The whole page: layout, link, themes, languages, keyboard, screen readers.
import { afterAll, beforeAll, describe, expect, test } from 'vitest';

import { still_hall } from './hall';
import { is_in_view, broken_link, picture, sizes, Stage, violations } from './harness';

let stage: Stage;

beforeAll(async () => {
  stage = await Stage.set(...still_hall);
});
afterAll(() => stage.strike());

describe('the page', () => {
  test('connects by itself and shows the engine', () =>
    stage.page(async (page) => {
      await page.getByText('Connected', { exact: true }).waitFor();
      await page.getByRole('treeitem', { name: /^speech_synthesis / }).waitFor();
      await page.locator('.engine-component', { hasText: 'navigation' }).getByText('READY').waitFor();
      expect(await page.title()).toBe('RoIS console');
      await picture(page, 'shell-wide-dark');
    }));

  test('the first view transfers less than 120 KiB, and only the scripts of its panels', () =>
    stage.page(async (page) => {
      await page.getByRole('treeitem', { name: /^speech_synthesis / }).waitFor();
      await page.locator('.map-canvas').waitFor();
      await page.locator('.timeline-canvas').waitFor();
      const files = await page.evaluate(() => performance.getEntriesByType('resource').map(({ name }) => new URL(name).pathname).filter((path) => path.startsWith('/assets/')));
      const scripts = new Set(files.flatMap((path) => /^\/assets\/(\w+)-.*\.js$/.exec(path)?.[1] ?? []));
      expect([...scripts].sort(), 'other panels are fetched when first shown').toEqual(['components', 'index', 'map', 'shared', 'timeline']);
      let bytes = 0;
      for (const path of ['/', ...files]) bytes += Number((await fetch(stage.gateway.url + path, { headers: { 'Accept-Encoding': 'gzip' } })).headers.get('Content-Length'));
      expect(bytes).toBeGreaterThan(50 * 1024);
      expect(bytes).toBeLessThan(120 * 1024);
    }));

  test('a panel that could not be fetched shows the error, and is fetched on retry', () =>
    stage.page(
      async (page) => {
        await page.getByText('Connected', { exact: true }).waitFor();
        await page.route('**/assets/health-*.js', (route) => route.abort());
        await page.getByRole('tab', { name: 'Health' }).click();
        await page.getByRole('alert').getByText('Failed to fetch').waitFor();
        await page.getByRole('alert').getByText('If it fails again, reload the page.').waitFor();
        await page.unroute('**/assets/health-*.js');
        await page.getByRole('button', { name: 'Try again' }).click();
        await page.locator('.health-figures').waitFor();
      },
      { may_complain: /./ },
    ));

  test.each([
    ['wide', 'dark', 'en'],
    ['tablet', 'light', 'en'],
    ['small', 'dark', 'ja'],
    ['phone', 'light', 'en'],
  ] as const)('is accessible: %s, %s, %s', (size, look, language) =>
    stage.page(
      async (page) => {
        await page.getByRole('treeitem', { name: /^speech_synthesis / }).waitFor();
        await page.locator('.engine-component', { hasText: 'navigation' }).getByText('READY').waitFor();
        expect(await violations(page)).toBe('');
        expect(await page.evaluate(() => document.documentElement.lang)).toBe(language);
        const tabs = page.locator('.app-main .tabs-row').first().getByRole('tab');
        const boxes = await tabs.evaluateAll((all) => all.map((one) => one.getBoundingClientRect()));
        if (sizes[size].width > 1099) expect(Math.max(...boxes.map((one) => one.right)), 'all tabs are visible').toBeLessThanOrEqual(sizes[size].width);
        else expect(new Set(boxes.map((one) => one.top)).size, 'one row of tabs, which scrolls').toBe(1);
        await tabs.last().click();
        expect(await is_in_view(tabs.last())).toBe(true);
        const menu = page.locator('.head summary');
        if (sizes[size].width > 1099) expect(await menu.count()).toBe(0);
        else {
          await menu.click();
          expect(await is_in_view(page.locator('.head select').first())).toBe(true);
          expect(await violations(page)).toBe('');
          await page.keyboard.press('Escape');
          expect(await page.locator('.head select').first().isVisible()).toBe(false);
        }
        await page.getByRole('tab', { name: language === 'ja' ? 'コンポーネント' : 'Components' }).click();
        await picture(page, `shell-${size}-${look}-${language}`);
      },
      { ...sizes[size], look, language, touch: size !== 'wide' },
      '/#components',
    ),
  );

  test('without JavaScript leads to the plain page at its top', async () => {
    const page = await (await fetch(stage.front.url)).text();
    expect(page.indexOf('<a href="/plain">')).toBeGreaterThan(page.indexOf('<noscript>'));
    expect(page.indexOf('<a href="/plain">')).toBeLessThan(page.indexOf('id="console"'));
  });

  test('is accessible in a low window, panel by panel, without content', () =>
    stage.page(async (page) => {
      await page.getByRole('treeitem', { name: /^speech_synthesis / }).waitFor();
      for (const name of await page.getByRole('tab').allTextContents()) {
        await page.getByRole('tab', { name, exact: true }).click();
        expect(await violations(page), name).toBe('');
      }
    }, sizes.laptop), 180_000);

  test('is accessible on a phone, panel by panel: nothing is cut off or too small to touch', () =>
    stage.page(
      async (page) => {
        await page.getByRole('heading', { name: 'Reception hall' }).waitFor();
        for (const name of await page.getByRole('tablist').first().getByRole('tab').allTextContents()) {
          await page.getByRole('tab', { name, exact: true }).click();
          expect(await violations(page), name).toBe('');
          const wrong = await page.evaluate(() =>
            [...document.querySelectorAll<HTMLElement>('button, select, label, summary, [role=tab], [role=treeitem]')].flatMap((one) => {
              const { width, height, right } = one.getBoundingClientRect();
              const is_pressed = !one.matches('label') || one.querySelector('input[type=checkbox]') !== null;
              if (width === 0 || !is_pressed || one.closest('.unseen, dialog:not([open])')) return [];
              const is_cut = right > innerWidth + 1 && !one.closest('[role=tablist], .scenario-panel');
              return height < 35.5 || is_cut ? [`${one.tagName} ${one.textContent} ${width} x ${height}, until ${right}`] : [];
            }),
          );
          expect(wrong, name).toEqual([]);
          expect(await page.evaluate(() => document.documentElement.scrollWidth), name).toBeLessThanOrEqual(sizes.phone.width);
        }
      },
      { ...sizes.phone, touch: true },
    ), 180_000);

  test('shows the lost link, stale data, and the reconnection', () =>
    stage.page(
      async (page) => {
        await page.getByText('Connected', { exact: true }).waitFor();
        stage.front.cut();
        await page.getByText('Connection lost', { exact: true }).waitFor();
        await page.getByText(/The data is .* old/).waitFor();
        await page.getByText('Not live', { exact: true }).waitFor();
        expect(await violations(page)).toBe('');
        await picture(page, 'shell-lost');
        stage.front.restore();
        await page.getByText('Connected again', { exact: true }).waitFor();
      },
      { may_complain: broken_link },
    ));

  test('does not animate with reduced motion', () =>
    stage.page(
      async (page) => {
        const moving = () => page.evaluate(() => [...document.querySelectorAll('*')].filter((one) => /[1-9]/.test(getComputedStyle(one).transitionDuration + getComputedStyle(one).animationDuration)).length);
        await page.getByText('Connected', { exact: true }).waitFor();
        expect(await moving()).toBeGreaterThan(0);
        await page.emulateMedia({ reducedMotion: 'reduce' });
        expect(await moving()).toBe(0);
        expect(await page.evaluate(() => document.getAnimations().length)).toBe(0);
      },
      { motion: 'no-preference' },
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

  test('ends its session on request, and begins a new one', () =>
    stage.page(async (page) => {
      await page.getByRole('treeitem', { name: /^person_detection / }).click();
      await page.getByRole('button', { name: 'Bind person_detection' }).click();
      await page.getByText('1 bound').waitFor();
      await page.getByRole('button', { name: 'Disconnect' }).click();
      const question = page.getByRole('dialog', { name: 'Disconnect?' });
      await question.getByText('This ends the session and releases 1 bound component.').waitFor();
      expect(await violations(page)).toBe('');
      await question.getByRole('button', { name: 'Disconnect' }).click();
      await page.getByText('Disconnected', { exact: true }).waitFor();
      await page.getByText('0 bound').waitFor();
      expect(await page.getByRole('treeitem').getByText('READY').count()).toBe(0); // unknown
      await page.getByRole('button', { name: 'Connect', exact: true }).click();
      await page.getByText('Connected', { exact: true }).waitFor();
    }));

  test('is operated by keyboard alone: everything is reachable, visible and named, and the focus is never trapped', () =>
    stage.page(async (page) => {
      await page.getByRole('treeitem', { name: /^navigation / }).click();
      await page.getByRole('heading', { name: 'navigation', exact: true }).waitFor();
      await page.evaluate(() => {
        document.body.tabIndex = -1; // starts at the top
        document.body.focus();
      });
      const walked: string[] = [];
      for (let i = 0; i < 120; ++i) {
        await page.keyboard.press('Tab');
        const at = await page.evaluate(focused);
        if (at === undefined || (walked.length > 0 && at === walked[0])) break;
        walked.push(at);
      }
      await picture(page, 'shell-focus');
      expect(walked[0]).toBe('Skip to the panels');
      for (const name of ['Colours', 'Language', 'Place to go to', 'Larger', 'Stop time', 'Time range', 'navigation', 'Release navigation|Bind navigation', 'Commands', 'start', 'target_position, item 1', 'Copy as curl', 'Request: navigation start'])
        expect(walked.some((one) => new RegExp(`^(${name})`).test(one)), `${name} in ${walked.join(' | ')}`).toBe(true);
      expect(walked.filter((one) => one.startsWith('!'))).toEqual([]);

      await page.evaluate(() => (document.activeElement as HTMLElement).blur());
      await page.getByText('Skip to the panels').focus();
      await page.keyboard.press('Enter');
      expect(await page.evaluate(() => document.activeElement?.id)).toBe('panels');
    }));
});

// The name of the focused element, with a leading ! if it is not visible or has no name. Runs in the page.
function focused(): string | undefined {
  const at = document.activeElement as HTMLElement | null;
  if (!at || at === document.body) return undefined;
  const labelled = at.getAttribute('aria-labelledby')?.split(' ').map((id) => document.getElementById(id)?.textContent).join(' ');
  const name = (at.getAttribute('aria-label') ?? labelled ?? (at as HTMLInputElement).labels?.[0]?.textContent ?? at.textContent ?? '').trim();
  const box = at.getBoundingClientRect();
  const style = getComputedStyle(at);
  const is_seen = box.width > 0 && box.height > 0 && box.top >= 0 && box.left >= 0 && (style.outlineStyle !== 'none' || style.backgroundColor !== getComputedStyle(at.parentElement!).backgroundColor);
  return is_seen && name !== '' ? name : `!${at.outerHTML.slice(0, 80)}`;
}
