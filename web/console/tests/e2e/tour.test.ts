// The first ten minutes of a new user (docs/tour.md), and the pictures of the docs.
import { execFile } from 'node:child_process';
import { mkdir } from 'node:fs/promises';
import { promisify } from 'node:util';

import type { Page } from 'playwright-core';
import { describe, test } from 'vitest';

import { click_map, drag_area } from './floor';
import { Hall, set_still_hall, still_hall, takes_pictures } from './hall';
import { picture, pictures, root, sizes, Stage } from './harness';

const data = `${root}/tests/server/data`;
const size = { width: 1360, height: 850 };

/** A picture for docs/. Saved there, reduced, on request. */
async function shown(page: Page, name: string): Promise<void> {
  await picture(page, name);
  if (!takes_pictures) return;
  await mkdir(`${root}/docs/pictures`, { recursive: true });
  await promisify(execFile)('pngquant', ['--speed', '1', '--strip', '--force', '--output', `${root}/docs/pictures/${name}.png`, `${pictures}/${name}.png`]);
}

let stage: Stage;
let hall: Hall;
set_still_hall(async (...both) => {
  [stage, hall] = both;
  await hall.visit('tanaka', '12500, 5500, 180', { known: true });
  await hall.visit('guest', '10500, 8200, 200');
  await hall.enter('courier');
});

const row = (page: Page, name: RegExp) => page.locator('.map table tbody tr').filter({ has: page.getByRole('rowheader', { name }) });
const tab = (page: Page, name: string) => page.getByRole('tab', { name, exact: true }).click();

describe('a new user', () => {
  test('sends the robot to a visitor, makes it speak, receives events of persons in a box, runs two commands at once, and finds out why a command failed', () =>
    stage.page(
      async (page) => {
        // To a visitor, who appears when the robot looks.
        await row(page, /robot1/).getByText('Now').waitFor();
        await page.getByLabel('Time range').selectOption('30 s');
        await page.getByRole('switch', { name: 'Observe' }).click();
        await hall.pass_until(page, row(page, /tanaka|person-/).getByText(/x 12/), 200);
        await click_map(page, { x: 12_500, y: 5500 });
        await page.getByRole('region', { name: /^Person/ }).getByRole('button', { name: 'Go there' }).click();
        await page.getByRole('button', { name: 'Send here' }).click();
        await page.getByText(/^robot1 → /).waitFor();
        await hall.sets_out('courier', '15000, 4000');
        await hall.pass_until(page, row(page, /robot1/).getByText(/x [89]\./), 100);
        await shown(page, 'map');
        await hall.pass_until(page, page.getByText(/^robot1 has reached/));

        // Speech.
        await page.getByRole('treeitem', { name: /^speech_synthesis / }).click();
        await page.getByLabel('speech_text', { exact: true }).fill('Good morning. How can I help you?');
        await page.getByRole('button', { name: 'start', exact: true }).last().click();
        await hall.pass_until(page, page.locator('.exchange-came').getByText('Done.'), 200);

        // Persons in a box; one walks in.
        await tab(page, 'Conditions');
        const conditions = page.locator('.panel-conditions');
        await conditions.getByRole('radio', { name: 'Subscribe' }).click();
        await conditions.getByRole('button', { name: 'position_data within a box' }).click();
        await drag_area(page, { x: 7500, y: 10_000 }, { x: 13_500, y: 5000 });
        await conditions.getByRole('button', { name: 'Subscribe', exact: true }).click();
        await hall.sets_out('tanaka', '12800, 8500');
        await hall.pass_until(page, conditions.locator('.conditions-subscription').getByText(/^[1-9]\d* events?$/), 200);
        await shown(page, 'conditions');

        // Two commands at once.
        await tab(page, 'Sequences');
        const sequences = page.locator('.panel-sequence');
        const component = sequences.getByLabel('Component', { exact: true });
        await sequences.getByRole('button', { name: 'Two at the same time' }).click();
        await component.selectOption('speech_synthesis');
        await sequences.getByLabel('speech_text', { exact: true }).fill('This way, please.');
        await sequences.locator('.sequence-branch').nth(1).locator('.sequence-box').click();
        await component.selectOption('navigation');
        await sequences.getByLabel('target_position, item 1').fill('exhibit');
        const end = sequences.locator('.sequence-whole > .sequence-lane > .sequence-last');
        await end.hover();
        await end.getByRole('button', { name: 'Add a step here' }).click();
        await sequences.getByRole('button', { name: 'Command', exact: true }).click();
        await component.selectOption('reaction');
        await sequences.getByLabel('reaction_ref').fill('9');
        await sequences.getByRole('button', { name: 'Run', exact: true }).click();
        await hall.pass_until(page, sequences.locator('.sequence-box', { hasText: 'speech_synthesis' }).getByText('OK'), 200);
        await shown(page, 'sequence');
        await hall.pass_until(page, sequences.getByText(/^Completed after/));

        // Why a command failed.
        await tab(page, 'Floor map');
        await page.getByRole('treeitem', { name: /^navigation / }).click();
        await page.getByLabel('target_position, item 1').fill('17500, 7000');
        await page.getByRole('button', { name: 'start', exact: true }).last().click();
        await hall.pass_until(page, page.locator('.exchange-came').getByText('The component failed.'), 200);
        await page.locator('.exchange-came').getByText(/is outside of the hall, in a wall or in furniture/).first().scrollIntoViewIfNeeded();
        await shown(page, 'failed');

        await tab(page, 'Health');
        await page.locator('.health-legend strong').first().getByText(/\d/).waitFor();
        await shown(page, 'health');
      },
      { ...size, motion: 'no-preference' },
    ));
});

test('figure 1 runs, and the tablet shows it in Japanese', async () => {
  const watchful = await Stage.set(...still_hall, '--floor-plan', `${data}/watchful_hall.xml`);
  const world = await Hall.of(watchful);
  await world.visit('tanaka', '9000, 4500, 180', { known: true });
  await watchful.page(
    async (page) => {
      await tab(page, 'Visitors');
      await page.getByRole('button', { name: 'Start', exact: true }).click();
      await world.pass_until(page, page.locator('[data-state="say_message"][aria-current]'), 100, 120_000);
      await shown(page, 'scenario');
      await world.pass_until(page, page.getByText('visitors received: 1'), 500, 120_000);
    },
    { ...size, look: 'light', motion: 'no-preference' },
    '/#scenario',
  );
  await watchful.page(
    async (page) => {
      await page.getByRole('switch').click();
      await row(page, /robot1/).waitFor();
      await page.locator('.map-tools select, .map-bar select').first().selectOption('desk');
      await page.locator('.map-form button[type=submit]').click();
      await world.sets_out('tanaka', '11000, 7500');
      await world.pass_until(page, row(page, /robot1/).getByText(/x 7\./), 100);
      await shown(page, 'tablet');
    },
    { ...sizes.tablet, language: 'ja', look: 'light', touch: true },
  );
  await world.close();
  await watchful.strike();
});
