// The panel Visitors: people in the simulated hall who are let in, sent about, given words, and gone again; in a world that stands still,
// so that it is the same each time.
import type { Locator, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';

import type { Console } from '../../src/state/console';
import { still_hall } from './hall';
import { broken_link, looks, picture, root, sizes, Stage, violations } from './harness';

const data = `${root}/tests/server/data`;
let stage: Stage;
beforeAll(async () => {
  stage = await Stage.set(...still_hall);
});
afterAll(() => stage.strike());

const visitor = (page: Page, ref: string) => page.locator(`[data-visitor="${ref}"]`);
const at_desk = /^9\.[3-7] m, 9\.[1-4] m$/; // people stop as soon as they are there
const row = (page: Page, ref: string) => page.locator('.visitors-one', { hasText: ref });

async function let_in(page: Page, name: string, known = false): Promise<void> {
  await page.getByLabel('Name', { exact: true }).fill(name);
  if (known) await page.getByLabel('Identification knows them').check();
  await page.getByRole('button', { name: 'Let in' }).click();
}

/** Lets time pass until there are so many of something; through the page, which has the hall. */
async function pass_until(page: Page, shown: Locator, count = 1): Promise<void> {
  while ((await shown.count()) !== count) await page.evaluate(() => (window as unknown as { rois: Console }).rois.hall.let_pass(1000).then(() => undefined));
}

async function leaves(page: Page, name: string): Promise<void> {
  await row(page, name).click();
  await page.locator('.visitors-orders .button-danger').click();
  await pass_until(page, visitor(page, name), 0);
}

test('who is there is not known before the engine has said it, and has its age while the link is lost', () =>
  stage.page(
    async (page) => {
      await page.getByText('0 people in the hall').waitFor();
      stage.front.cut();
      await page.getByText(/^Not connected: as it was \d.* ago$/).waitFor();
      expect(await page.getByText('Nobody is in the hall').count()).toBe(0);
      expect(await page.getByRole('button', { name: 'Let in' }).isDisabled()).toBe(true);
      expect(await page.getByRole('button', { name: 'Let 1 second pass' }).isDisabled()).toBe(true);
      expect(await violations(page)).toBe('');
      stage.front.mend();
      await page.getByText('Nobody is in the hall').waitFor();
      await page.getByText('Disconnect', { exact: true }).click();
      await page.getByText('Who is in the hall is not known yet').waitFor();
    },
    { may_complain: broken_link },
    '/#visitors',
  ));

describe('in a world that stands still', () => {
  test('somebody comes in, is dragged, says and waves, and time is let pass', () =>
    stage.page(
      async (page) => {
        await page.getByText('The world stands still.').waitFor();
        await let_in(page, 'anna', true);
        await page.getByRole('listitem').filter({ hasText: 'anna' }).getByText('comes in when the entrance is free').waitFor();
        await page.getByRole('button', { name: 'Let 1 second pass' }).click();
        await page.getByText('comes in when the entrance is free').waitFor({ state: 'detached' });
        await pass_until(page, row(page, 'anna').getByText('known'));
        await row(page, 'anna').getByText('10.0 m, 0.7 m').waitFor();

        const from = (await visitor(page, 'anna').locator('.visitors-body').boundingBox())!;
        const hall = (await page.locator('.floor-ground').boundingBox())!;
        const mm = hall.width / 20_000; // px; the hall is 20 m wide
        await page.mouse.move(from.x + from.width / 2, from.y + from.height - 260 * mm);
        await page.mouse.down();
        await page.mouse.move(hall.x + 9000 * mm, hall.y + hall.height - 4500 * mm, { steps: 5 });
        await page.getByText(/^anna goes to (8\.9|9\.0)\d m, 4\.[45]\d m$/).waitFor();
        await picture(page, 'visitors-wide-dark-drag');
        await page.mouse.up();
        await row(page, 'anna').getByText('walking').waitFor();

        const language = page.locator('.visitors-orders').getByLabel('Language');
        await language.selectOption('ja');
        await page.getByLabel('Say', { exact: true }).fill('Good morning');
        await page.keyboard.press('Enter');
        expect(await language.inputValue()).toBe(''); // the next speech is in their own again
        await page.getByRole('button', { name: 'wave' }).click();
        await row(page, 'anna').getByText('walking, saying, gesture').waitFor();
        await picture(page, 'visitors-wide-dark');
        expect(await violations(page)).toBe('');
        for (const _ of [1, 2]) await page.getByRole('button', { name: 'Let 10 seconds pass' }).click();
        await row(page, 'anna').getByText(/walking|saying|gesture/).waitFor({ state: 'detached' });
        await row(page, 'anna').getByText(/^(8\.9|9\.[01]) m, 4\.[3-6] m$/).waitFor();
        await page.getByLabel('Walk to').selectOption('desk');
        await page.getByRole('button', { name: 'Go', exact: true }).click();
        await page.getByRole('button', { name: 'Let it flow' }).click();
        await row(page, 'anna').getByText(/, 5\.\d m$/).waitFor();
        await page.getByRole('button', { name: 'Halt' }).click();
        await leaves(page, 'anna');
        await page.getByText('0 bound').waitFor();
      },
      { width: 1600, height: 1000 },
      '/#visitors',
    ));

  test('several are sent to places, by the keyboard, too; what cannot be is told', () =>
    stage.page(
      async (page) => {
        await let_in(page, 'ben');
        await pass_until(page, row(page, 'ben'));
        await page.getByLabel('Walk to').selectOption('desk');
        await page.getByRole('button', { name: 'Go', exact: true }).click();
        await pass_until(page, row(page, 'ben').getByText(at_desk));
        await page.getByRole('button', { name: 'Let in' }).click(); // by the name that is proposed
        await pass_until(page, row(page, 'anna'));

        // The floor sends whoever is chosen.
        await page.getByText('Drag anna, or click where to go').waitFor();
        await page.locator('.visitors-floor .floor-ground').click({ position: { x: 40, y: 40 } });
        await row(page, 'anna').getByText('walking').waitFor();

        await visitor(page, 'anna').focus();
        for (const key of ['Shift+ArrowUp', 'Shift+ArrowUp', 'ArrowLeft']) await page.keyboard.press(key);
        await page.getByText('anna goes to 9.75 m, 2.75 m').waitFor();
        await page.keyboard.press('Enter');
        await pass_until(page, row(page, 'anna').getByText(/^9\.[78] m, 2\.[678] m$/));

        await page.getByLabel('Name', { exact: true }).fill('ben');
        await page.getByText('Somebody has this name already.').waitFor();
        expect(await page.getByRole('button', { name: 'Let in' }).isDisabled()).toBe(true);
        await page.getByLabel('Name', { exact: true }).fill('');
        await visitor(page, 'anna').focus();
        for (let i = 0; i < 8; ++i) await page.keyboard.press('Shift+ArrowUp'); // into the desk
        await page.keyboard.press('Enter');
        await page.getByText(/is outside of the hall, in a wall or in furniture/).waitFor();
        await leaves(page, 'anna');
        await leaves(page, 'ben');
      },
      {},
      '/#visitors',
    ));

  test.each(looks)('is accessible: %s, %s, %s', (size, look, language) =>
    stage.page(
      async (page) => {
        await page.locator('.visitors-entering button').click();
        await pass_until(page, page.locator('.visitors-orders'));
        expect(await violations(page)).toBe('');
        await picture(page, `visitors-${size}-${look}-${language}`);
        await leaves(page, 'anna');
      },
      { ...sizes[size], look, language, touch: size !== 'wide' },
      '/#visitors',
    ),
  );
});

test('a robot receives somebody who was let in: nothing but a browser is needed to try it', async () => {
  const watchful = await Stage.set(...still_hall, '--floor-plan', `${data}/watchful_hall.xml`);
  try {
    await watchful.page(
      async (page) => {
        await let_in(page, 'tanaka', true);
        await pass_until(page, row(page, 'tanaka'));
        await page.getByLabel('Walk to').selectOption('desk');
        await page.getByRole('button', { name: 'Go', exact: true }).click();
        await pass_until(page, row(page, 'tanaka').getByText(at_desk));
        await page.getByRole('tab', { name: 'Scenario' }).click();
        await page.getByRole('button', { name: 'Start', exact: true }).click();
        await pass_until(page, page.getByText('received 1 visitors'));
        expect(await page.locator('.scenario-printed').allTextContents()).toEqual(['tanaka: told "Mr. Tanaka, your meeting is in room 3."', 'received 1 visitors']);
        await picture(page, 'visitors-received');
      },
      { width: 1600, height: 1000 },
      '/#visitors',
    );
  } finally {
    await watchful.strike();
  }
});

test('an engine without a simulated hall says how one comes by visitors', async () => {
  const unsteered = await Stage.set('--scenario', `${data}/empty_hall.xml`, '--seed', '7');
  try {
    await unsteered.page(
      async (page) => {
        await page.getByText('This engine has no visitors to steer').waitFor();
        await page.getByText('--steering on').waitFor();
        expect(await violations(page)).toBe('');
        await picture(page, 'visitors-none');
      },
      {},
      '/#visitors',
    );
  } finally {
    await unsteered.strike();
  }
});
