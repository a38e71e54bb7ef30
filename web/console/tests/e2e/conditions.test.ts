// The Conditions panel: building filters, their present matches, and their use.
import type { Page } from 'playwright-core';
import { describe, expect, test } from 'vitest';

import { drag_area } from './floor';
import { type Hall, more_profiles, set_still_hall } from './hall';
import { looks, picture, sizes, type Stage, violations } from './harness';

let stage: Stage;
let hall: Hall;
const path = '/#conditions';
const panel = (page: Page) => page.locator('.panel-conditions');

set_still_hall(async (...both) => {
  [stage, hall] = both;
  await hall.visit('tanaka', '9000, 4500, 180', { known: true });
  await hall.visit('guest', '11000, 7000, 180');
}, ...more_profiles);

const request = (page: Page, operation: string) => panel(page).getByRole('region', { name: `Request: ${operation}` });
const count = (page: Page, text: string | RegExp) => panel(page).locator('.conditions-count').filter({ hasText: text }).waitFor();

describe('conditions', () => {
  test('subscribes to persons in a box picked on the map', () =>
    stage.page(
      async (page) => {
        await panel(page).getByRole('radio', { name: 'Subscribe' }).click();
        expect(await panel(page).getByLabel('Event', { exact: true }).inputValue()).toBe('person_localized');
        await panel(page).getByRole('button', { name: 'position_data within a box' }).click();
        await panel(page).getByLabel('Corner 1, x').fill('abc');
        await panel(page).getByText('Not a number').waitFor();
        await panel(page).getByLabel('Corner 1, x').fill('');
        await count(page, '1 component can send it');
        await drag_area(page, { x: 500, y: 11_500 }, { x: 19_500, y: 500 });
        expect(Number(await panel(page).getByLabel('Corner 1, x').inputValue())).toBeLessThan(1000);
        expect(await request(page, 'subscribe').textContent()).toMatch(/<fes:Within>[^]*position_data[^]*<gml:lowerCorner>/);
        await panel(page).getByRole('button', { name: 'Subscribe', exact: true }).click();
        await panel(page).getByText('No events yet.').waitFor();
        await panel(page).getByRole('button', { name: 'Start person_localization' }).click();
        await hall.pass_until(page, panel(page).locator('.conditions-subscription').getByText(/^[1-9]\d* events?$/), 200);
        await picture(page, 'conditions-box');
        expect(await violations(page)).toBe('');
        await panel(page).getByRole('button', { name: /^[1-9]\d* events?$/ }).click();
        await page.getByRole('listbox', { name: /^Documents/ }).getByText('person_localized').first().waitFor();
        expect(await page.getByLabel('Search in the text').inputValue()).toMatch(/^subscribe_id>.+<$/);
        await panel(page).getByRole('button', { name: 'Unsubscribe' }).click();
        await panel(page).locator('.conditions-subscription').waitFor({ state: 'detached' });
      },
      {},
      path,
    ));

  test('shows the number of matching components, by keyboard alone', () =>
    stage.page(
      async (page) => {
        await count(page, /^(\d+) of \1 components$/);
        await panel(page).getByRole('button', { name: 'a type of component' }).focus();
        await page.keyboard.press('Enter');
        await panel(page).getByLabel('Value', { exact: true }).focus();
        await page.keyboard.type('Navig');
        await count(page, /^1 of \d+ components$/);
        await panel(page).locator('.conditions-found').getByText('navigation', { exact: true }).waitFor();

        await panel(page).getByRole('button', { name: 'Group', exact: true }).press('Enter');
        const what = panel(page).getByLabel('What', { exact: true }).nth(1);
        await what.selectOption('status');
        await panel(page).getByLabel('Value', { exact: true }).nth(1).selectOption('READY');
        await panel(page).getByLabel('Which of these must be true').nth(1).selectOption('none of');
        expect(await request(page, 'search').textContent()).toMatch(/<fes:And>[^]*<fes:Not>[^]*READY/);
        await count(page, /^0 of \d+ components$/);
        await panel(page).getByRole('button', { name: 'Remove the group' }).press('Enter');
        await count(page, /^1 of \d+ components$/);

        // It is kept across panels and visits.
        await page.getByRole('tab', { name: 'Sequences' }).click();
        await page.getByRole('tab', { name: 'Conditions' }).click();
        await page.reload();
        await count(page, /^1 of \d+ components$/);
        expect(await violations(page)).toBe('');
      },
      {},
      path,
    ));

  test('binds any, the nearest first, and queries', () =>
    stage.page(
      async (page) => {
        await panel(page).getByRole('radio', { name: 'Bind any' }).click();
        await panel(page).getByRole('button', { name: 'nearest first' }).click();
        await panel(page).getByLabel('Place', { exact: true }).fill('desk');
        await panel(page).getByRole('button', { name: 'Condition', exact: true }).click();
        await panel(page).getByLabel('What', { exact: true }).first().selectOption('component_ref');
        await panel(page).getByLabel('How', { exact: true }).selectOption('looks like');
        await panel(page).getByLabel('Value', { exact: true }).fill('*_localization');
        await count(page, /^3 of \d+ components$/);
        expect(await request(page, 'bind_any').textContent()).toMatch(/PropertyIsLike[^]*fes:SortBy[^]*name="distance"[^]*desk/);
        await panel(page).getByRole('button', { name: 'Bind any', exact: true }).click();
        await panel(page).locator('.exchange-came').getByText('OK', { exact: true }).waitFor();
        await page.getByText('1 bound').waitFor();

        await panel(page).getByRole('button', { name: 'Clear' }).click();
        await panel(page).getByRole('radio', { name: 'Query' }).click();
        await panel(page).getByLabel('Query', { exact: true }).last().selectOption('robot_position');
        await panel(page).getByRole('button', { name: 'Ask', exact: true }).click();
        await panel(page).getByRole('region', { name: 'Results: query' }).getByText('robot1').waitFor();
        await picture(page, 'conditions-query');
        expect(await violations(page)).toBe('');
      },
      {},
      path,
    ));

  test("shows missing values, and the engine's refusal", () =>
    stage.page(
      async (page) => {
        await panel(page).getByRole('button', { name: 'Condition', exact: true }).click();
        await panel(page).getByText('One condition is incomplete').or(panel(page).getByText('2 conditions are incomplete')).waitFor();
        await panel(page).getByText('Choose a property').first().waitFor();
        expect(await panel(page).getByRole('button', { name: 'Search', exact: true }).isDisabled()).toBe(true);
        await panel(page).getByText('Something is missing above.').waitFor();
        await panel(page).getByLabel('What', { exact: true }).selectOption('location');
        await panel(page).getByLabel('How', { exact: true }).selectOption('is within a place');
        await panel(page).getByLabel('Place', { exact: true }).fill('nowhere');
        await panel(page).locator('.field-error').getByText(/the place 'nowhere', which is not known here/).waitFor();
        await panel(page).getByRole('button', { name: 'Search', exact: true }).click();
        await panel(page).locator('.exchange-came').getByText('BAD_PARAMETER').first().waitFor();
        expect(await violations(page)).toBe('');
      },
      {},
      path,
    ));

  test('imports a pasted condition', () =>
    stage.page(
      async (page) => {
        await panel(page).getByRole('button', { name: 'Paste XML' }).click();
        const area = panel(page).getByRole('textbox', { name: 'As XML' });
        await area.fill('<fes:Filter><nonsense');
        await panel(page).getByRole('button', { name: 'Import' }).click();
        await panel(page).getByText(/Invalid: /).waitFor();
        await area.fill(`<subscribe xmlns="urn:x-rois:psm:xml:message:1" xmlns:fes="http://www.opengis.net/fes/2.0"><event_type>person_detected</event_type><condition>
          <fes:Filter><fes:PropertyIsGreaterThan><fes:ValueReference>number</fes:ValueReference><fes:Literal>1</fes:Literal></fes:PropertyIsGreaterThan></fes:Filter></condition></subscribe>`);
        await panel(page).getByRole('button', { name: 'Import' }).click();
        expect(await panel(page).getByLabel('Event', { exact: true }).inputValue()).toBe('person_detected');
        expect(await panel(page).getByLabel('What', { exact: true }).inputValue()).toBe('number');
        await panel(page).getByLabel('Value', { exact: true }).fill('many');
        await panel(page).getByText('Not a number').waitFor();
      },
      {},
      path,
    ));

  test.each(looks)('is accessible: %s, %s, %s', (size, look, language) =>
    stage.page(
      async (page) => {
        await panel(page).locator('.conditions-radio').nth(2).click();
        await panel(page).locator('.conditions-chips button').nth(2).click();
        await panel(page).locator('.conditions-add button').nth(1).click();
        await panel(page).locator('.conditions-tools button').first().click();
        await panel(page).locator('.conditions-found li').first().waitFor();
        expect(await violations(page)).toBe('');
        await picture(page, `conditions-${size}-${look}-${language}`);
      },
      { ...sizes[size], look, language, touch: size !== 'wide' },
      path,
    ),
  );
});
