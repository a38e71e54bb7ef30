// The Scenario panel: figure 1 runs and is edited in the browser, as with `rois scenario`.
import { execFile } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { promisify } from 'node:util';

import type { Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';

import { Hall } from './hall';
import { looks, picture, root, sizes, Stage, violations } from './harness';

const data = `${root}/tests/server/data`;
const day = ['--floor-plan', `${data}/watchful_hall.xml`, '--scenario', `${data}/three_visitors.xml`, '--sim-speed', '0', '--seed', '7'];
const reception = `${root}/client-cpp/scenarios/reception.xml`;
const wanted = { visitors: '3', identifying: '3', listening: '10', looking: '3' };
const an_hour = 3_600_000; // ms
const rois = resolve(process.env['ROIS_BINARY_DIR'] ?? `${root}/build/release`, 'bin/rois');

let stage: Stage;
let hall: Hall;
beforeAll(async () => {
  stage = await Stage.set(...day);
  hall = await Hall.of(stage);
});
afterAll(async () => {
  await hall.close();
  await stage.strike();
});

const greeting = `<robot_scenario xmlns="urn:x-rois:scenario:1" name="Greeting" start="wait">
  <component name="speech_synthesis"/>
  <variable name="words">Welcome.</variable>
  <state name="wait">
    <after seconds="60" to="nobody"/>
  </state>
  <end name="nobody" failed="true"><print>nobody answered {words}</print></end>
</robot_scenario>
`;

const in_diagram = (page: Page, name: string) => page.locator(`[data-state="${name}"]`);
const start = (page: Page) => page.getByRole('button', { name: 'Start', exact: true });

async function open_file(page: Page, name: string, text: string): Promise<void> {
  const [chooser] = await Promise.all([page.waitForEvent('filechooser'), page.getByRole('button', { name: 'Open …' }).click()]);
  await chooser.setFiles({ name, mimeType: 'application/xml', buffer: Buffer.from(text) });
  await page.getByText(name, { exact: true }).waitFor();
}

describe('the reception of figure 1', () => {
  test('prints in the browser what `rois scenario` prints, on the same day', async () => {
    const history = readFileSync(`${data}/three_visitors.txt`, 'utf8').trim().split('\n');
    const same_day = await Stage.set(...day);
    const world = await Hall.of(same_day);
    const given = Object.entries(wanted).map(([name, value]) => `${name}=${value}`);
    const { stdout } = await world.pass_while(promisify(execFile)(rois, ['scenario', reception, ...given, '--quiet', '--url', same_day.gateway.url]));
    expect(stdout.trim().split('\n')).toEqual(history);
    await world.close();
    await same_day.strike();

    await stage.page(
      async (page) => {
        await page.getByText('Connected', { exact: true }).waitFor();
        for (const [name, value] of Object.entries(wanted)) await page.getByLabel(`Initial value of ${name}`).fill(value);
        await start(page).click();
        await page.getByText('Running', { exact: true }).waitFor();
        await hall.pass_until(page, page.locator('.scenario-printed'), 500, an_hour);
        await picture(page, 'scenario-wide-dark-running');
        await hall.pass_until(page, page.getByText('visitors received: 3', { exact: true }), 500, an_hour);
        expect(await page.locator('.scenario-printed').allTextContents()).toEqual(history);
        await page.getByText('Ended in “all received”', { exact: true }).waitFor();
        expect(await in_diagram(page, 'all_received').getAttribute('aria-current')).toBe('step');
        expect(await page.locator('.scenario-edge-last title').textContent()).toBe('completed');
        expect(await page.locator('tr', { hasText: 'received' }).locator('.scenario-value').textContent()).toBe('tanaka, suzuki');
        const first = page.locator('.scenario-transition').first();
        expect(await first.textContent()).toMatch(/^\d\d:\d\d:\d\dlook where the start is →,  check presenceanswered$/);
        await page.getByText('0 bound').waitFor();
        expect(await violations(page)).toBe('');
      },
      { width: 1600, height: 1000 },
      '/#scenario',
    );
  });

  test('is stopped from the page, and everything is released', () =>
    stage.page(
      async (page) => {
        await open_file(page, 'greeting.xml', greeting);
        await start(page).click();
        await in_diagram(page, 'wait').and(page.locator('[aria-current]')).waitFor();
        await page.getByText('1 bound').waitFor();
        await page.getByRole('tab', { name: 'Edit' }).click();
        await page.getByText('Running. Stop it to edit.').waitFor();
        await page.getByRole('button', { name: 'Stop', exact: true }).click();
        await page.getByText('Stopped', { exact: true }).waitFor();
        await page.getByText('0 bound').waitFor();
      },
      {},
      '/#scenario',
    ));
});

describe('a scenario', () => {
  test('is edited in forms, validated before it runs, and saved with its layout', () =>
    stage.page(
      async (page) => {
        await page.getByRole('tab', { name: 'Edit' }).click();
        await page.getByLabel('State', { exact: true }).selectOption('bow');
        expect(await page.evaluate(() => document.documentElement.scrollHeight <= innerHeight)).toBe(true); // however long the form is
        await open_file(page, 'greeting.xml', greeting);
        await in_diagram(page, 'wait').click();
        const after = page.locator('[data-element="after"]');
        await after.getByRole('textbox', { name: 'seconds' }).fill('0');
        await after.getByLabel('Add … after seconds').selectOption('when');
        await after.getByLabel('holds when it').selectOption('is not');
        await after.getByLabel('is not').last().fill('Go away.');
        await page.locator('[data-state="wait"]').waitFor();
        await page.getByRole('tab', { name: 'XML' }).click();
        const xml = page.getByLabel('The scenario as XML');
        const changed = greeting.replace('<after seconds="60" to="nobody"/>', '<after seconds="0" to="nobody">\n      <when variable="words" is_not="Go away."/>\n    </after>');
        expect(await xml.inputValue()).toBe(changed);

        await xml.fill(changed.replace('to="nobody"', 'to="somebody"'));
        await page.getByText("no state 'somebody'; there are wait, nobody").waitFor();
        expect(await page.getByText('line 5, column 5').count()).toBe(1);
        expect(await start(page).isDisabled()).toBe(true);
        expect(await violations(page)).toBe('');
        await page.getByRole('button', { name: 'Undo' }).click();
        expect(await xml.inputValue()).toBe(changed);

        const [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: 'Save' }).click()]);
        expect([download.suggestedFilename(), readFileSync(await download.path(), 'utf8')]).toEqual(['greeting.xml', changed]);
        await start(page).click();
        await page.getByText('Failed in nobody', { exact: true }).waitFor();
        expect(await page.locator('.scenario-printed').allTextContents()).toEqual(['nobody answered Welcome.']);

        await page.reload(); // it is stored
        await page.getByText('greeting.xml', { exact: true }).waitFor();
        await page.getByRole('button', { name: 'Reception example' }).click();
        await in_diagram(page, 'all_received').waitFor();
      },
      {},
      '/#scenario',
    ));

  test('that this engine does not support completely shows warnings before it runs', () =>
    stage.page(
      async (page) => {
        await open_file(page, 'odd.xml', greeting.replace('</state>', '<leaving><command component="speech_synthesis" type="sing"/></leaving></state>').replace('<after', '<event type="unknown_event" to="wait"/><after'));
        await page.getByText('Not supported by this engine (2)').click();
        await page.getByText("speech_synthesis has no command 'sing'").waitFor();
        await page.getByText("no matching component sends the event 'unknown_event'").waitFor();
      },
      {},
      '/#scenario',
    ));

  test('is operated by keyboard', () =>
    stage.page(
      async (page) => {
        await in_diagram(page, 'look_where_the_start_is').focus();
        await page.keyboard.press('ArrowDown');
        await page.keyboard.press('ArrowDown');
        await picture(page, 'scenario-focus');
        await page.keyboard.press('Enter');
        expect(await page.getByLabel('State', { exact: true }).inputValue()).toBe('find');
        expect(await page.evaluate(() => document.activeElement?.getAttribute('data-state'))).toBe('find');
        expect(await in_diagram(page, 'find').getAttribute('aria-label')).toBe('State find. person_localized: to approach, after {looking} s: to go to start position');
      },
      {},
      '/#scenario',
    ));

  test.each(looks)('is accessible: %s, %s, %s', (size, look, language) =>
    stage.page(
      async (page) => {
        await in_diagram(page, 'ask').click();
        await page.locator('[data-element="event"]').waitFor();
        expect(await violations(page)).toBe('');
        await picture(page, `scenario-${size}-${look}-${language}-edit`);
        await page.getByRole('tab', { name: 'XML' }).click();
        expect(await violations(page)).toBe('');
        await page.locator('.scenario-panel [role=tab]').first().click();
        expect(await violations(page)).toBe('');
        await picture(page, `scenario-${size}-${look}-${language}-run`);
      },
      { ...sizes[size], look, language, touch: size !== 'wide' },
      '/#scenario',
    ),
  );
});
