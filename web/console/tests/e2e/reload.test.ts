// What the page keeps of a moving robot: its trail across panels, its time line across a reload.
import type { Page } from 'playwright-core';
import { describe, expect, test } from 'vitest';

import type { Console } from '../../src/state/console';
import { type Hall, set_still_hall } from './hall';
import type { Stage } from './harness';

let stage: Stage;
let hall: Hall;

set_still_hall(async (...both) => {
  [stage, hall] = both;
  await hall.pass(1000);
});

const ready = (page: Page) => page.locator('.map table tbody tr').filter({ has: page.getByRole('rowheader', { name: 'robot1' }) }).getByText('Now').waitFor();

describe('the trail of the robot', () => {
  test('continues while another panel is shown instead of the map', () =>
    stage.page(async (page) => {
      await ready(page);
      const robot = () => page.evaluate(() => {
        const { at, trail } = (window as unknown as { rois: Console }).rois.robots.all.get('robot1')!;
        return { at, points: trail.list().map(({ begins }) => begins === true) };
      });
      await page.getByRole('tab', { name: 'Sequences' }).click();
      await page.locator('.map').waitFor({ state: 'detached' });
      const before = (await robot()).points.length;
      await page.evaluate(() => (window as unknown as { rois: Console }).rois.run('navigation', 'start', { target_position: ['waiting_area'] }).then(() => undefined));
      for (let step = 0; step < 24; ++step) {
        await hall.pass(240);
        const { at } = await robot();
        await expect.poll(async () => (await robot()).at).toBeGreaterThan(at);
      }
      const { points } = await robot();
      expect(points.length).toBeGreaterThan(before + 3);
      expect(points).not.toContain(true); // no gap
      await page.getByRole('tab', { name: 'Floor map' }).click();
      await ready(page);
      expect((await robot()).points.length).toBeGreaterThanOrEqual(points.length);
      await page.locator('.map-motion').getByRole('button', { name: 'Stop robot1' }).click();
      await hall.pass_until(page, page.locator('.map:not(:has(.map-motion))'), 100);
    }));
});

describe('a reloaded page', () => {
  test('asks before leaving while the robot drives, and keeps its time line', () =>
    stage.page(async (page) => {
      await ready(page);
      await page.getByLabel('Place to go to').selectOption('desk');
      await page.getByRole('button', { name: 'Send here' }).click();
      await page.locator('.map-motion').waitFor();
      const asked: string[] = [];
      page.on('dialog', (dialog) => {
        asked.push(dialog.type());
        void dialog.accept();
      });
      await page.reload();
      expect(asked).toEqual(['beforeunload']);
      await ready(page);
      const known = () => page.evaluate(() => (window as unknown as { rois: Console }).rois.commands.all.list().map((one) => [one.component, one.command_type, one.state]));
      expect(await known()).toContainEqual(['navigation', 'start', 'unknown']);
      await page.reload();
      await ready(page);
      expect(asked.length).toBe(1);
      expect(await known()).toContainEqual(['navigation', 'start', 'unknown']);
    }));
});
