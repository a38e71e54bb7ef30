// The Visitors panel: simulated people come in, walk, speak and leave; with stopped time, so that every run is the same.
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
const at_desk = /^9\.[3-7] m, 9\.[1-4] m$/; // people stop as soon as they arrive
const row = (page: Page, ref: string) => page.locator('.visitors-one', { hasText: ref });

async function let_in(page: Page, name: string, known = false): Promise<void> {
  await page.getByLabel('Name', { exact: true }).fill(name);
  if (known) await page.getByLabel('Known to identification').check();
  await page.getByRole('button', { name: 'Let in' }).click();
}

/** Lets time pass until there are `count` of something; through the page, which has bound the hall. */
async function pass_until(page: Page, shown: Locator, count = 1): Promise<void> {
  while ((await shown.count()) !== count) await page.evaluate(() => (window as unknown as { rois: Console }).rois.hall.let_pass(1000).then(() => undefined));
}

async function leaves(page: Page, name: string): Promise<void> {
  await row(page, name).click();
  await page.locator('.visitors-orders .button-danger').click();
  await pass_until(page, visitor(page, name), 0);
}

test('visitors are unknown until the engine has answered, and have their age while the link is lost', () =>
  stage.page(
    async (page) => {
      await page.getByText('0 people in the hall').waitFor();
      stage.front.cut();
      await page.getByText(/^Not connected: as it was \d.* ago$/).waitFor();
      expect(await page.getByText('The hall is empty').count()).toBe(0);
      expect(await page.getByRole('button', { name: 'Let in' }).isDisabled()).toBe(true);
      expect(await page.getByRole('button', { name: 'Let 1 second pass' }).isDisabled()).toBe(true);
      expect(await violations(page)).toBe('');
      stage.front.restore();
      await page.getByText('The hall is empty').waitFor();
      await page.getByText('Disconnect', { exact: true }).click();
      await page.getByText('The people in the hall are not known yet').waitFor();
    },
    { may_complain: broken_link },
    '/#visitors',
  ));

describe('with stopped time', () => {
  test('a visitor comes in, is dragged, speaks and waves, and time passes on request', () =>
    stage.page(
      async (page) => {
        await page.getByText('Time is stopped.').waitFor();
        await let_in(page, 'anna', true);
        await page.getByRole('listitem').filter({ hasText: 'anna' }).getByText('comes in when the entrance is free').waitFor();
        await page.getByRole('button', { name: 'Let 1 second pass' }).click();
        await page.getByText('comes in when the entrance is free').waitFor({ state: 'detached' });
        await pass_until(page, row(page, 'anna').getByText('known'));
        await row(page, 'anna').getByText('10.0 m, 0.7 m').waitFor();

        const from = (await visitor(page, 'anna').locator('.visitors-body').boundingBox())!;
        const hall = (await page.locator('.floor-ground').boundingBox())!;
        const mm = hall.width / 20_000; // px per mm; the hall is 20 m wide
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
        expect(await language.inputValue()).toBe(''); // the next speech is in the visitor's own language again
        await page.getByRole('button', { name: 'wave' }).click();
        await row(page, 'anna').getByText('walking, saying, gesture').waitFor();
        await picture(page, 'visitors-wide-dark');
        expect(await violations(page)).toBe('');
        for (const _ of [1, 2]) await page.getByRole('button', { name: 'Let 10 seconds pass' }).click();
        await row(page, 'anna').getByText(/walking|saying|gesture/).waitFor({ state: 'detached' });
        await row(page, 'anna').getByText(/^(8\.9|9\.[01]) m, 4\.[3-6] m$/).waitFor();
        await page.getByLabel('Walk to').selectOption('desk');
        await page.getByRole('button', { name: 'Go', exact: true }).click();
        await page.getByRole('button', { name: 'Let time run' }).click();
        await row(page, 'anna').getByText(/, [5-9]\.\d m$/).waitFor();
        await page.getByRole('button', { name: 'Halt' }).click();
        await leaves(page, 'anna');
        await page.getByText('0 bound').waitFor();
      },
      { width: 1600, height: 1000 },
      '/#visitors',
    ));

  test('several visitors are sent to places, also by keyboard, and failures are reported', () =>
    stage.page(
      async (page) => {
        await let_in(page, 'ben');
        await pass_until(page, row(page, 'ben'));
        await page.getByLabel('Walk to').selectOption('desk');
        await page.getByRole('button', { name: 'Go', exact: true }).click();
        await pass_until(page, row(page, 'ben').getByText(at_desk));
        await page.getByRole('button', { name: 'Let in' }).click(); // with the proposed name
        await pass_until(page, row(page, 'anna'));

        // A click on the floor sends the selected visitor.
        await page.getByText('Drag anna, or click the target').waitFor();
        await page.locator('.visitors-floor .floor-ground').click({ position: { x: 40, y: 40 } });
        await row(page, 'anna').getByText('walking').waitFor();

        await visitor(page, 'anna').focus();
        for (const key of ['Shift+ArrowUp', 'Shift+ArrowUp', 'ArrowLeft']) await page.keyboard.press(key);
        await page.getByText('anna goes to 9.75 m, 2.75 m').waitFor();
        await page.keyboard.press('Enter');
        await pass_until(page, row(page, 'anna').getByText(/^9\.[78] m, 2\.[678] m$/));

        await page.getByLabel('Name', { exact: true }).fill('ben');
        await page.getByText('This name is already used.').waitFor();
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

test('a robot receives a visitor who was let in: a browser is enough to try it', async () => {
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
        await pass_until(page, page.getByText('visitors received: 1'));
        expect(await page.locator('.scenario-printed').allTextContents()).toEqual(['tanaka: told "Mr. Tanaka, your meeting is in room 3."', 'visitors received: 1']);
        await picture(page, 'visitors-received');
      },
      { width: 1600, height: 1000 },
      '/#visitors',
    );
  } finally {
    await watchful.strike();
  }
});

test('an engine without a simulated hall explains how to get visitors', async () => {
  const unsteered = await Stage.set('--scenario', `${data}/empty_hall.xml`, '--seed', '7');
  try {
    await unsteered.page(
      async (page) => {
        await page.getByText('This engine has no visitors to control').waitFor();
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
