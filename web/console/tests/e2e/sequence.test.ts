// The sequence editor: drawing, validation, running and progress.
import type { Page } from 'playwright-core';
import { describe, expect, test } from 'vitest';

import { type Hall, more_profiles, set_still_hall } from './hall';
import { looks, picture, sizes, type Stage, violations } from './harness';

let stage: Stage;
let hall: Hall;
const path = '/#sequence';
const panel = (page: Page) => page.locator('.panel-sequence');

set_still_hall(async (...both) => {
  [stage, hall] = both;
  await hall.pass(1000);
}, ...more_profiles);

const box = (page: Page, text: string) => panel(page).locator('.sequence-box', { hasText: text });
const component = (page: Page) => panel(page).getByLabel('Component', { exact: true });
const open_library = (page: Page) => panel(page).getByRole('button', { name: 'Open or save …' }).click();

/** Two parallel branches: speech and navigation. */
async function greeting(page: Page, target = 'desk'): Promise<void> {
  expect(await panel(page).getByRole('button', { name: 'Run', exact: true }).isDisabled()).toBe(true);
  await panel(page).getByRole('button', { name: 'Two at the same time' }).click();
  await component(page).selectOption('speech_synthesis');
  await panel(page).getByLabel('speech_text', { exact: true }).fill('This way, please.');
  await panel(page).locator('.sequence-branch').nth(1).locator('.sequence-box').click();
  await component(page).selectOption('navigation');
  await panel(page).getByLabel('target_position, item 1').fill(target);
}

describe('sequences', () => {
  test('a parallel sequence is built with the mouse, run, and shown while it runs', () =>
    stage.page(
      async (page) => {
        await greeting(page, 'exit');
        // After both: a wait and a reaction.
        await panel(page).locator('.sequence-whole > .sequence-lane > .sequence-last').hover();
        expect(await panel(page).locator('.sequence-add').evaluateAll((all) => all.every((one) => Number(getComputedStyle(one).opacity) >= 0.5)), 'visible without hovering').toBe(true);
        await panel(page).locator('.sequence-whole > .sequence-lane > .sequence-last').getByRole('button', { name: 'Add a step here' }).click();
        await panel(page).getByRole('button', { name: 'Wait', exact: true }).click();
        await expect.poll(() => panel(page).getByLabel('How long').evaluate((one) => one === document.activeElement)).toBe(true);
        await panel(page).getByLabel('How long').fill('300');
        await panel(page).getByRole('button', { name: 'Add a step', exact: true }).click();
        await panel(page).getByRole('button', { name: 'Command', exact: true }).click();
        await component(page).selectOption('reaction');
        await panel(page).getByLabel('reaction_ref').fill('28');
        await panel(page).getByRole('tab', { name: 'XML' }).click();
        const xml = await panel(page).getByRole('region', { name: 'The execute request as XML' }).textContent();
        expect(xml).toMatch(/ConcurrentCommandsType[^]*branch_list[^]*speech_synthesis[^]*branch_list[^]*navigation[^]*delay_time="300"[^]*reaction/);
        await panel(page).getByRole('button', { name: 'Copy as curl' }).click();
        expect(await page.evaluate(() => navigator.clipboard.readText())).toContain('<execute');
        await panel(page).getByRole('button', { name: 'Run', exact: true }).click();
        await box(page, 'navigation').getByText('running').waitFor();
        await box(page, 'branches at once').getByText('running').waitFor();
        await picture(page, 'sequence-running');
        await hall.pass_until(page, panel(page).getByText(/^Completed after/));
        await box(page, 'reaction').getByText('OK').waitFor();
        await page.getByText('0 bound').waitFor();
        expect(await violations(page)).toBe('');
      },
      {},
      path,
    ));

  test('steps are dragged into a branch, and back by undo', () =>
    stage.page(
      async (page) => {
        await greeting(page);
        await panel(page).locator('.sequence-parallel > .sequence-box').click();
        await page.keyboard.press('Insert');
        await panel(page).getByRole('button', { name: 'Wait', exact: true }).click();
        const order = () => panel(page).locator('.sequence-box').evaluateAll((all) => all.map((one) => (one.querySelector('.sequence-title') ?? one).textContent!.trim()));
        expect(await order()).toEqual(['2 branches at once', 'speech_synthesis', 'navigation', 'Wait']);
        const from = (await box(page, 'Wait').boundingBox())!;
        const to = (await box(page, 'speech_synthesis').boundingBox())!;
        await page.mouse.move(from.x + 20, from.y + 10);
        await page.mouse.down();
        await page.mouse.move(to.x + 30, to.y + 20, { steps: 6 });
        await panel(page).locator('.sequence-target').waitFor();
        await picture(page, 'sequence-drag');
        await page.mouse.up();
        expect(await order()).toEqual(['2 branches at once', 'Wait', 'speech_synthesis', 'navigation']);
        await panel(page).getByRole('button', { name: /^Undo/ }).click();
        expect(await order()).toEqual(['2 branches at once', 'speech_synthesis', 'navigation', 'Wait']);
      },
      {},
      path,
    ));

  test('everything works by keyboard', () =>
    stage.page(
      async (page) => {
        await panel(page).getByRole('button', { name: 'A command', exact: true }).press('Enter');
        await page.waitForFunction(() => document.activeElement?.tagName === 'SELECT');
        await component(page).selectOption('speech_synthesis');
        await panel(page).getByLabel('speech_text', { exact: true }).fill('Good day.');
        await box(page, 'speech_synthesis').focus();
        await page.keyboard.press('Insert');
        await page.waitForFunction(() => document.activeElement?.closest('.sequence-choices'));
        await page.keyboard.press('Tab');
        await page.keyboard.press('Enter'); // branches
        const parallel = box(page, 'branches at once');
        await parallel.waitFor();
        await page.waitForFunction(() => document.activeElement?.textContent?.includes('branches'));
        await page.keyboard.press('ArrowLeft');
        await page.keyboard.press('Alt+ArrowDown');
        await panel(page).locator('.sequence-branch').first().locator('.sequence-box', { hasText: 'speech_synthesis' }).waitFor();
        await page.waitForFunction(() => document.activeElement?.closest('.sequence-branch'));
        await page.keyboard.press('Alt+ArrowDown');
        await panel(page).locator('.sequence-branch').nth(1).locator('.sequence-box', { hasText: 'speech_synthesis' }).waitFor();
        await page.waitForFunction(() => document.activeElement?.closest('.sequence-branch'));
        await page.keyboard.press('Alt+ArrowRight');
        await panel(page).locator('.sequence-branch .sequence-box').waitFor({ state: 'detached' });
        await page.waitForFunction(() => document.activeElement?.textContent?.includes('speech_synthesis'));
        await page.keyboard.press('ArrowLeft');
        await page.keyboard.press('Delete');
        await parallel.waitFor({ state: 'detached' });
        await page.waitForFunction(() => document.activeElement?.textContent?.includes('speech_synthesis'));
        await page.keyboard.press('Enter');
        await page.waitForFunction(() => document.activeElement?.tagName === 'SELECT');
        await panel(page).getByRole('button', { name: 'Run', exact: true }).press('Enter');
        await hall.pass_until(page, panel(page).getByText(/^Completed after/));
        expect(await violations(page)).toBe('');
      },
      {},
      path,
    ));

  test('missing values, refusals and failures are shown at their steps', () =>
    stage.page(
      async (page) => {
        await greeting(page, 'nowhere');
        await panel(page).getByRole('button', { name: 'Add a step', exact: true }).click();
        await panel(page).getByRole('button', { name: 'Command', exact: true }).click();
        await component(page).selectOption('follow');
        await panel(page).getByRole('button', { name: 'Run', exact: true }).click();
        await panel(page).getByText('Required.').first().waitFor();
        await box(page, 'follow').getByText('not complete').waitFor();
        await box(page, 'follow').press('Delete');
        await panel(page).getByRole('button', { name: 'Run', exact: true }).click();
        await box(page, 'navigation').getByText('refused').waitFor();
        await panel(page).locator('.sequence-form').getByText(/is not a valid target: expected "x, y"/).waitFor();
        await panel(page).getByLabel('target_position, item 1').fill('100000, 2000');
        await panel(page).getByRole('button', { name: 'Run', exact: true }).click();
        await hall.pass_until(page, box(page, 'navigation').getByText('ERROR'), 200);
        await hall.pass_until(page, box(page, 'speech_synthesis').getByText('OK'), 200);
        await panel(page).getByText('navigation start ended with ERROR.').waitFor();
        await panel(page).getByRole('button', { name: 'Show the step' }).click();
        await panel(page).getByText('The component failed.').waitFor();
        await picture(page, 'sequence-failed');
        expect(await violations(page)).toBe('');
      },
      {},
      path,
    ));

  test('running and waiting commands are stopped', () =>
    stage.page(
      async (page) => {
        await greeting(page);
        await component(page).selectOption('follow');
        await panel(page).getByLabel('target_object_ref').fill('nobody');
        await panel(page).getByLabel(/^distance/).fill('500');
        await panel(page).locator('.sequence-branch').first().locator('.sequence-box').click();
        await panel(page).getByLabel('Waits before it starts').fill('3600000');
        await panel(page).getByRole('button', { name: 'Run', exact: true }).click();
        await box(page, 'follow').getByText('running').waitFor();
        await panel(page).getByRole('button', { name: 'Stop', exact: true }).click();
        await hall.pass_until(page, box(page, 'follow').getByText('OK'), 200); // its end after stop
        await panel(page).getByText('Released: speech_synthesis.').waitFor();
        await page.getByText('0 bound').waitFor();
        const run = panel(page).getByRole('button', { name: 'Run', exact: true });
        expect(await run.isEnabled()).toBe(false); // waiting commands would run, too
        await page.getByRole('button', { name: 'Disconnect' }).click();
        await page.getByRole('dialog', { name: 'Disconnect?' }).getByRole('button', { name: 'Disconnect' }).click();
        await page.getByRole('button', { name: 'Connect', exact: true }).click();
        await box(page, 'speech_synthesis').getByText(/^(ABORT|unknown)$/).waitFor();
        await page.waitForFunction(() => !(document.querySelector('.sequence-toolbar button') as HTMLButtonElement).disabled);
      },
      {},
      path,
    ));

  test('sequences are stored by name, exported and imported', () =>
    stage.page(
      async (page) => {
        await greeting(page);
        await open_library(page);
        await panel(page).getByLabel('Name', { exact: true }).fill('Greeting');
        await panel(page).getByRole('button', { name: 'Save in this browser' }).click();
        const [download] = await Promise.all([page.waitForEvent('download'), panel(page).getByRole('button', { name: 'Export' }).click()]);
        expect(download.suggestedFilename()).toBe('Greeting.xml');
        const file = await download.path();
        expect(await violations(page)).toBe('');
        await picture(page, 'sequence-library');
        await panel(page).getByRole('button', { name: 'New', exact: true }).click();
        await panel(page).getByRole('button', { name: 'A command', exact: true }).waitFor();
        await page.reload();
        await open_library(page);
        await panel(page).getByRole('button', { name: 'Open Greeting' }).click();
        await box(page, 'navigation').getByText('desk').waitFor();
        await open_library(page);
        await panel(page).getByRole('button', { name: 'Forget Greeting' }).click();
        await panel(page).getByRole('button', { name: 'New', exact: true }).click();
        await open_library(page);
        await panel(page).getByLabel('Or XML text').fill('<a/>');
        await panel(page).getByRole('button', { name: 'Import' }).click();
        await panel(page).getByText('It has no CommandUnitSequence with commands').waitFor();
        await panel(page).getByLabel('An XML file').setInputFiles({ name: 'Other.xml', mimeType: 'text/xml', buffer: await import('node:fs/promises').then(({ readFile }) => readFile(file)) });
        await box(page, 'speech_synthesis').getByText('This way, please.').waitFor();
        await panel(page).getByText('Other', { exact: true }).waitFor();
      },
      {},
      path,
    ));

  test.each(looks)('is accessible: %s, %s, %s', (size, look, language) =>
    stage.page(
      async (page) => {
        await panel(page).locator('.sequence-beginning button').nth(1).click();
        await panel(page).locator('.sequence-fields select').first().selectOption('speech_synthesis');
        await panel(page).getByLabel('speech_text', { exact: true }).fill('Irasshaimase');
        await panel(page).locator('.sequence-branch').nth(1).locator('.sequence-box').click();
        await panel(page).locator('.sequence-fields select').first().selectOption('move');
        await panel(page).locator('.sequence-add-branch').click();
        await panel(page).locator('.sequence-branch').nth(2).locator('.sequence-add').click();
        await panel(page).locator('.sequence-choices').waitFor();
        expect(await violations(page)).toBe('');
        await picture(page, `sequence-${size}-${look}-${language}`);
      },
      { ...sizes[size], look, language, touch: size !== 'wide' },
      path,
    ),
  );
});
