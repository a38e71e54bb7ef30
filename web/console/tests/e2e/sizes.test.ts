// Screens of several sizes: elements that must be visible and must not move.
import type { Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';

import type { Console } from '../../src/state/console';
import { on_map } from './floor';
import { type Hall, set_still_hall, still_hall } from './hall';
import { is_in_view, picture, root, sizes, Stage } from './harness';

let stage: Stage;
let hall: Hall;

set_still_hall(async (...both) => {
  [stage, hall] = both;
  await hall.visit('anna', 'desk');
});

type Page_ = Window & { rois: Console };
const named = ['wide', 'small', 'phone'] as const;
const options = (size: (typeof named)[number]) => ({ ...sizes[size], touch: size !== 'wide' });
const tab = (page: Page, name: string) => page.getByRole('tab', { name, exact: true }).click();
const top_of = (page: Page, selector: string) => page.locator(selector).evaluate((one) => one.getBoundingClientRect().top);

test.each(named)('rows of events show the positions of persons: %s', (size) =>
  stage.page(async (page) => {
    await page.getByText('Connected', { exact: true }).waitFor();
    await page.evaluate(() => (window as unknown as Page_).rois.subscribe('person_localized').then(() => undefined));
    await hall.run(page, 'person_localization', 'start');
    await tab(page, 'Events and messages');
    const row = page.getByRole('option').filter({ hasText: 'person_localized' }).filter({ hasText: /person-\d+ \d+\.\d\d, \d+\.\d\d m/ });
    await hall.pass_until(page, row, 200);
    const is_cut = row.last().evaluate((one) => [...one.querySelectorAll('span')].filter((part) => !part.matches('.unseen') && part.scrollWidth > part.clientWidth && getComputedStyle(part).overflow === 'hidden').map((part) => part.textContent));
    expect(await is_cut).toEqual([]);
    await picture(page, `rows-${size}`);
    await tab(page, 'Time line');
    await page.getByLabel('As a table').check();
    const listed = page.getByRole('button', { name: /^Open: Event, person_localized/ }).filter({ hasText: /person-\d+ \d+\.\d\d, \d+\.\d\d m/ }).first();
    await listed.waitFor();
    expect(await is_in_view(listed)).toBe(true);
    expect(await listed.evaluate((one) => one.scrollWidth <= one.clientWidth)).toBe(true);
    await picture(page, `listing-${size}`);
  }, options(size)));

describe('on a phone', () => {
  test('the target is not covered while the robot drives, and the map shows the person', () =>
    stage.page(async (page) => {
      await page.getByRole('heading', { name: 'Reception hall' }).waitFor();
      await hall.run(page, 'person_localization', 'start');
      await page.getByRole('button', { name: 'Table' }).tap();
      await hall.pass_until(page, page.getByRole('button', { name: /^Choose: person-/ }), 200);
      await page.getByRole('button', { name: /^Choose: person-/ }).tap();
      await page.getByRole('button', { name: 'Table' }).tap();
      await page.getByRole('button', { name: 'Go there' }).tap();
      const before = await top_of(page, '.map-floor');
      await page.getByRole('button', { name: 'Send here' }).tap();
      const motion = page.locator('.map-motion');
      await motion.getByText(/^robot1 → person-\d+$/).waitFor();
      await picture(page, 'motion-phone');
      expect(await page.getByRole('region', { name: 'Notices' }).locator('> *').count()).toBe(0);
      const board = (await page.locator('.map-canvas').boundingBox())!;
      const said = (await motion.boundingBox())!;
      expect(said.y + said.height).toBeLessThanOrEqual(board.y + 1);
      expect(await top_of(page, '.map-floor')).toBe(before);
      const at = await on_map(page, { x: 10_000, y: 11_800 });
      expect(await page.evaluate(([x, y]) => document.elementFromPoint(x!, y!)!.className, [at.x, at.y])).toContain('map-canvas');
      await hall.pass_until(page, page.getByText(/^robot1 has reached person-/), 500);
      expect(await top_of(page, '.map-floor')).toBe(before);
      expect(await is_in_view(page.getByRole('button', { name: 'Close' }).first())).toBe(true);
      await picture(page, 'notice-phone');
      expect(await is_in_view(page.getByRole('tab').first())).toBe(true);
      expect(await is_in_view(page.getByText('Menu', { exact: true }))).toBe(true);
    }, options('phone')));

  test.each(['en', 'ja'] as const)('the height of the header does not depend on the age of the data: %s', (language) =>
    stage.page(async (page) => {
      await page.locator('.link-age').waitFor();
      const heights = await page.locator('.link-age').evaluate((age) => {
        const said = age.textContent!;
        return [36, 137, 1200, 25_000].map((ms) => {
          age.textContent = ms < 1000 ? said.replace(/\d+/, String(ms)) : said.replace(/\d+ ?(ms|ミリ秒)/, `${ms / 1000} s`);
          const { width, height } = document.querySelector('header')!.getBoundingClientRect();
          return `${width} x ${height}, ${document.documentElement.scrollWidth}`;
        });
      });
      expect(new Set(heights).size).toBe(1);
      await picture(page, `header-${language}`);
    }, { ...options('phone'), language }));
});

describe('with two robots', () => {
  let two: Stage;
  beforeAll(async () => (two = await Stage.set(...still_hall, '--floor-plan', `${root}/components/simulation/data/two-robots.xml`)));
  afterAll(() => two.strike());
  const cut = (page: Page, selector: string) =>
    page.locator(selector).evaluateAll((those) => those.filter((one) => one.scrollWidth > one.clientWidth + 1 || one.getBoundingClientRect().height > one.parentElement!.clientHeight).map((one) => one.textContent));

  test('names of components are readable on a phone', () =>
    two.page(async (page) => {
      await page.getByRole('heading', { name: 'Reception hall' }).waitFor();
      await page.evaluate(() => (window as unknown as Page_).rois.run('robot2.person_identification', 'start').then(() => undefined));
      await tab(page, 'Components');
      await page.getByRole('treeitem', { name: /^robot2.person_identification / }).getByText('bound by me').waitFor();
      expect(await cut(page, '.engine-ref')).toEqual([]);
      await page.getByRole('treeitem', { name: /^robot2.person_identification / }).scrollIntoViewIfNeeded();
      await picture(page, 'components-two-phone');
      await tab(page, 'Time line');
      await page.locator('.timeline-name', { hasText: 'robot2.person_identification' }).waitFor();
      expect(await cut(page, '.timeline-name span')).toEqual([]);
      await page.locator('.timeline-name', { hasText: 'robot2.person_identification' }).scrollIntoViewIfNeeded();
      await picture(page, 'timeline-two-phone');
    }, options('phone')));

  test('a click on the floor sends the robot whose card is open, and so does the card', () =>
    two.page(async (page) => {
      await page.getByRole('button', { name: 'Table' }).click();
      await page.getByRole('button', { name: 'Choose: robot2' }).click();
      await page.getByRole('button', { name: 'Table' }).click();
      await picture(page, 'card-two-wide');
      const at = await on_map(page, { x: 10_000, y: 4000 });
      await page.mouse.click(at.x, at.y);
      await page.getByRole('region', { name: 'Send robot2' }).waitFor();
      await page.getByRole('button', { name: 'Cancel' }).click();
      await page.getByRole('button', { name: 'Table' }).click();
      await page.getByRole('button', { name: 'Choose: robot1' }).click();
      await page.getByRole('region', { name: 'Robot robot1' }).getByLabel('Place to go to').selectOption('exhibit');
      await page.getByRole('region', { name: 'Send robot1' }).waitFor();
      await page.getByRole('button', { name: 'Table' }).click();
    }));
});
