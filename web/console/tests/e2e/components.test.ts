// The Components panel: tree, forms and outcomes of commands, parameters, queries and events.
import type { Page } from 'playwright-core';
import { connect } from 'rois-client';
import { describe, expect, test } from 'vitest';

import { type Hall, more_profiles, set_still_hall } from './hall';
import { is_in_view, looks, picture, sizes, type Stage, violations } from './harness';

let stage: Stage;
let hall: Hall;

set_still_hall(async (...both) => {
  [stage, hall] = both;
  await hall.pass(1000);
}, ...more_profiles);

const item = (page: Page, ref: string) => page.getByRole('treeitem', { name: new RegExp(`^${ref} `) });

async function open(page: Page, ref: string): Promise<void> {
  await item(page, ref).click();
  await page.getByRole('heading', { name: ref, exact: true }).waitFor();
}
const answer = (page: Page) => page.locator('.exchange-came');
const shows_answer = (page: Page, text: string) => hall.pass_until(page, answer(page).getByText(text), 200);

describe('components', () => {
  test('a command is sent with its XML and its answer, and ends', () =>
    stage.page(async (page) => {
      await open(page, 'speech_synthesis');
      await page.getByText(/Type string\. Default en\./).waitFor();
      await page.getByLabel('speech_text', { exact: true }).fill('Good morning.');
      await page.getByLabel('volume', { exact: true }).fill('loud');
      await page.getByText('Enter a whole number.').waitFor();
      await page.getByRole('button', { name: 'start', exact: true }).last().click();
      await page.locator('input[aria-invalid="true"]:focus').waitFor();
      await page.getByLabel('volume', { exact: true }).fill('70');
      const request = page.getByRole('region', { name: 'Request: speech_synthesis start' });
      expect(await request.textContent()).toMatch(/<rois:value>Good morning\.<\/rois:value>[^]*<rois:value>70<\/rois:value>/);
      await page.getByRole('button', { name: 'start', exact: true }).last().click();
      await shows_answer(page, 'Done.');
      expect(await item(page, 'speech_synthesis').getByText('running').count()).toBe(0);
      expect(await page.getByRole('region', { name: 'Answer: speech_synthesis start' }).textContent()).toContain('execute_response');
      await picture(page, 'components-command');
      // It was released, so its parameters do not apply to the next speech.
      expect(await page.getByLabel(/^Release the component when/).isChecked()).toBe(true);
      await page.getByText('0 bound').waitFor();
      await open(page, 'person_detection');
      expect(await page.getByLabel(/^Release the component when/).isChecked()).toBe(false);
      expect(await violations(page)).toBe('');
    }));

  test('a refused and a failed command show their reasons', () =>
    stage.page(async (page) => {
      await open(page, 'navigation');
      const target = page.getByLabel('target_position, item 1');
      await page.getByRole('button', { name: 'start', exact: true }).last().click();
      await page.getByText('Required.').waitFor();
      await target.fill('nowhere');
      await page.getByRole('button', { name: 'start', exact: true }).last().click();
      await answer(page).getByText(/nowhere' is not a valid target: expected "x, y", .* one of the places/).first().waitFor();
      await expect.poll(() => is_in_view(answer(page).locator('p').first())).toBe(true);
      await target.fill('100000, 2000');
      await page.getByRole('button', { name: 'start', exact: true }).last().click();
      await shows_answer(page, 'The component failed.');
      expect(await violations(page)).toBe('');
      await target.fill('17500, 7000');
      await page.getByRole('button', { name: 'start', exact: true }).last().click();
      const reason = answer(page).getByText(/is outside of the hall, in a wall or in furniture/).first();
      await hall.pass_until(page, reason);
      await expect.poll(() => is_in_view(answer(page).locator('> div').first())).toBe(true);
      expect(await is_in_view(reason)).toBe(true);
      await picture(page, 'components-low');

      await target.fill('exit');
      await page.getByRole('button', { name: 'Add to target_position' }).click();
      await page.getByLabel('target_position, item 2').fill('desk');
      await page.getByRole('button', { name: 'start', exact: true }).last().click();
      await answer(page).getByText('Running.').waitFor();
      await open(page, 'follow');
      await page.getByLabel('target_object_ref').fill('nobody');
      await page.getByLabel('distance').fill('500');
      await page.getByRole('button', { name: 'start', exact: true }).last().click();
      await answer(page).getByText('A required resource is in use.').waitFor();
      await answer(page).getByText('Running on the same robot: navigation start.').waitFor();
      await picture(page, 'components-failed');

      // Entered values are kept.
      await open(page, 'navigation');
      expect(await page.getByLabel('target_position, item 2').inputValue()).toBe('desk');
      await answer(page).getByText('Running.').waitFor();
      await page.getByRole('button', { name: 'Release navigation' }).click();
      await item(page, 'navigation').getByText('bound by me').waitFor({ state: 'detached' });
    }, sizes.low));

  test('a running command is stopped', () =>
    stage.page(async (page) => {
      await open(page, 'follow');
      await page.getByLabel('target_object_ref').fill('nobody');
      await page.getByLabel('distance').fill('500');
      await page.getByLabel(/^Release the component when/).check();
      await page.getByRole('button', { name: 'start', exact: true }).last().click();
      await answer(page).getByText('Running.').waitFor();
      await item(page, 'follow').getByText('running').waitFor();
      // Another form shows it, too.
      await page.getByRole('button', { name: 'resume', exact: true }).click();
      await page.locator('.panel-components').getByText('The answer appears here.').waitFor();
      await page.getByRole('button', { name: 'Stop follow start' }).click();
      await page.getByRole('button', { name: 'Stop follow start' }).waitFor({ state: 'detached' });
      await page.getByRole('button', { name: 'start', exact: true }).click();
      await shows_answer(page, 'Done.');
      await item(page, 'follow').getByText('bound by me').waitFor({ state: 'detached' });
    }));

  test('current parameters are shown, and set', () =>
    stage.page(async (page) => {
      await open(page, 'reaction');
      await page.getByRole('tab', { name: /^Parameters/ }).click();
      const now = page.getByRole('region', { name: 'Current values' });
      await now.getByText('available_reactions').waitFor();
      await page.getByRole('button', { name: 'Set', exact: true }).click();
      await page.getByText('Nothing entered yet.').waitFor();
      expect(await page.getByLabel('reaction_ref', { exact: true }).evaluate((one: HTMLInputElement) => one.list?.options.length)).toBe(50);
      await page.getByLabel('reaction_ref', { exact: true }).fill('28');
      expect(await page.getByRole('region', { name: 'Request: reaction set_parameter' }).textContent()).toContain('rois:codebook_ref="urn:x-rois:def:codebook:simulation::reaction"');
      await page.getByRole('button', { name: 'Set', exact: true }).click();
      await now.locator('tr', { hasText: 'reaction_ref' }).getByText('28 – wave the hand').waitFor();
      await page.getByLabel('Choose from a list').selectOption({ label: '9 – bow the head' });
      expect(await page.getByLabel('reaction_ref', { exact: true }).inputValue()).toBe('9');
      await page.getByText('“bow the head”.').waitFor();
      await picture(page, 'components-parameters');
      expect(await violations(page)).toBe('');
    }));

  test('a query shows its results', () =>
    stage.page(async (page) => {
      await open(page, 'system_information');
      await page.getByRole('tab', { name: /^Queries/ }).click();
      await page.getByRole('button', { name: 'robot_position', exact: true }).last().click();
      const results = page.getByRole('region', { name: 'Results: system_information robot_position' });
      await results.getByText('robot1').waitFor();
      expect(await results.textContent()).toMatch(/\d+, \d+, -?\d+/);
      expect(await violations(page)).toBe('');
    }));

  test('an event is subscribed to, arrives, and is unsubscribed', () =>
    stage.page(async (page) => {
      await open(page, 'person_detection');
      await page.getByRole('tab', { name: /^Events(?! and)/ }).click();
      await page.getByLabel(/^Further condition/).fill('<fes:PropertyIs');
      await page.getByText(/Invalid XML/).waitFor();
      await page.getByLabel(/^Further condition/).fill('<fes:PropertyIsLessThan><fes:ValueReference>number</fes:ValueReference><fes:Literal>100</fes:Literal></fes:PropertyIsLessThan>');
      await page.getByRole('button', { name: 'Subscribe', exact: true }).click();
      await answer(page).getByText('OK', { exact: true }).waitFor();
      await page.getByRole('tab', { name: /^Commands/ }).click();
      await page.getByRole('button', { name: 'start', exact: true }).last().click();
      await shows_answer(page, 'Done.');
      await page.getByRole('tab', { name: /^Events(?! and)/ }).click();
      await hall.pass_until(page, page.locator('.component-list').getByText('number: 0'), 200);
      await page.getByText('1 event', { exact: false }).first().waitFor();
      await picture(page, 'components-events');
      expect(await violations(page)).toBe('');
      await page.getByRole('button', { name: /^Unsubscribe / }).click();
      await page.getByText('Active subscriptions').waitFor({ state: 'detached' });
    }));

  test('a command of a custom profile has a form; a request is copied for a shell', () =>
    stage.page(async (page) => {
      await open(page, 'wheelchair_robot');
      expect(await page.getByRole('button', { name: 'brake', exact: true }).first().getAttribute('aria-pressed')).toBe('true');
      await page.getByRole('button', { name: 'brake', exact: true }).last().click();
      await page.getByText('Required.').waitFor();
      await page.getByLabel('status').selectOption('true');
      await page.getByRole('button', { name: 'brake', exact: true }).last().click();
      await shows_answer(page, 'Done.');
      await page.getByRole('button', { name: 'Copy as curl' }).click();
      await page.getByRole('button', { name: 'Copied' }).waitFor();
      expect(await page.evaluate(() => navigator.clipboard.readText())).toMatch(/^curl -s -H 'Content-Type: application\/xml' -H 'RoIS-Session: [^']+' -d '<execute [^]*http:\/\/127\.0\.0\.1:\d+\/rois$/);
    }));

  test('the owner of a component is shown, and a component of another session cannot be bound', async () => {
    const other = await connect(stage.gateway.url);
    await other.bind('reaction');
    await stage.page(async (page) => {
      await open(page, 'reaction');
      await item(page, 'reaction').getByText(/bound by (another )?session/).waitFor();
      await page.getByRole('button', { name: 'Bind reaction' }).click();
      await page.getByRole('alert').getByText(/Another application has bound it/).waitFor();
      await other.release('reaction');
      await item(page, 'reaction').getByText(/bound by/).waitFor({ state: 'detached' });
      await page.getByRole('button', { name: 'Bind reaction' }).click();
      await item(page, 'reaction').getByText('bound by me').waitFor();
    });
    await other.close();
  });

  test('the person to follow is chosen from those present', async () => {
    await hall.visit('tanaka', '9000, 4500, 180', { known: true });
    await stage.page(async (page) => {
      await open(page, 'person_localization');
      await page.getByRole('button', { name: 'start', exact: true }).last().click();
      await shows_answer(page, 'Done.');
      await open(page, 'follow');
      await hall.pass_until(page, page.locator('datalist option[value="person-1"]'));
      await page.getByLabel('target_object_ref').fill('person-1');
      expect(await page.getByRole('region', { name: 'Request: follow start' }).textContent()).toContain('rois:codebook_ref="urn:x-rois:def:codebook:simulation::track"');
      await page.getByLabel('distance').fill('800');
      await page.locator('.field', { has: page.getByLabel('distance') }).getByText('mm', { exact: true }).waitFor();
      await page.getByRole('button', { name: 'start', exact: true }).last().click();
      await answer(page).getByText('Running.').waitFor();
    });
    await hall.leave('tanaka');
  });

  test('the list fills the panel until a component is selected, keeps the selection visible, and stays usable with long names', () =>
    stage.page(async (page) => {
      await item(page, 'wheelchair_robot').waitFor();
      const [list, panel] = await Promise.all([page.getByRole('tree'), page.locator('.panel-components')].map((one) => one.locator('xpath=..').evaluate((frame) => frame.clientHeight)));
      expect(list! / panel!).toBeGreaterThan(0.75);
      await open(page, 'wheelchair_robot');
      await expect.poll(() => is_in_view(item(page, 'wheelchair_robot'))).toBe(true);
      await page.getByRole('heading', { name: 'wheelchair_robot' }).evaluate((name) => (name.textContent = 'wheelchair_'.repeat(12)));
      expect(await is_in_view(page.getByRole('button', { name: 'Bind wheelchair_robot' }))).toBe(true);
    }, sizes.laptop));

  test('the tree is operated by keyboard, and shows the owners', () =>
    stage.page(async (page) => {
      await item(page, 'face_detection').waitFor();
      await page.getByRole('treeitem', { name: 'reception', exact: true }).focus();
      await page.keyboard.press('ArrowDown'); // simulated_hall, which belongs to no robot
      await page.keyboard.press('ArrowDown'); // the robot
      await page.keyboard.press('ArrowDown');
      await page.keyboard.press('ArrowDown');
      await page.keyboard.press('Enter');
      await page.getByRole('heading', { name: 'face_localization' }).waitFor();
      await page.keyboard.press('ArrowLeft');
      await page.keyboard.press('ArrowLeft');
      await item(page, 'face_detection').waitFor({ state: 'detached' });
      await page.keyboard.press('ArrowRight');
      await page.keyboard.press('End');
      await page.keyboard.press(' ');
      await page.getByRole('heading', { name: 'wheelchair_robot' }).waitFor();
      // Tab leads from the tree over the divider to the component.
      await page.keyboard.press('Tab');
      await page.keyboard.press('Tab');
      expect(await page.evaluate(() => document.activeElement?.getAttribute('aria-label'))).toBe('Bind wheelchair_robot');
      await page.keyboard.press('Enter');
      await item(page, 'wheelchair_robot').getByText('bound by me').waitFor();
    }));

  test.each(looks)('looks well and is accessible: %s, %s, %s', (size, look, language) =>
    stage.page(
      async (page) => {
        await open(page, 'navigation');
        await item(page, 'navigation').getByText('READY').waitFor();
        expect(await violations(page)).toBe('');
        await picture(page, `components-${size}-${look}-${language}`);
      },
      { ...sizes[size], look, language, touch: size !== 'wide' },
      '/#components',
    ),
  );
});
