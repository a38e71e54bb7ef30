// Events and messages: listing, filtering, reading, details, gaps, and recordings for `rois replay`.
import { writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { resolve } from 'node:path';

import type { Page } from 'playwright-core';
import { command as start, connect } from 'rois-client';
import { describe, expect, test } from 'vitest';

import { Hall, set_still_hall, still_hall } from './hall';
import { broken_link, looks, picture, sizes, Stage, violations } from './harness';
import { replayed } from './replay';

let stage: Stage;
let hall: Hall;

set_still_hall(async (...both) => {
  [stage, hall] = both;
  stage.path = '/#messages';
}, '--resume-window', '0.01');

const row = (page: Page, text: string | RegExp) => page.getByRole('option').filter({ hasText: text });
const event_row = (page: Page) => row(page, 'person_detected').filter({ has: page.getByTitle('receive_event') });
const kind = (page: Page, name: string) => page.getByRole('group', { name: 'Kinds' }).getByRole('button', { name, exact: true });

async function command(page: Page, ref: string, world = hall): Promise<void> {
  await page.getByRole('treeitem', { name: new RegExp(`^${ref} `) }).click();
  await page.getByRole('heading', { name: ref, exact: true }).waitFor();
  await page.getByRole('tab', { name: /^Commands/ }).click();
  await page.getByRole('button', { name: 'start', exact: true }).last().click();
  await world.pass_until(page, page.locator('.exchange-came').getByText('Done.'), 200);
}

// The number of open sessions, as the gateway counts them.
async function sessions(): Promise<number> {
  const metrics = await (await fetch(`${stage.gateway.url}/metrics`)).text();
  return Number(/^rois_sessions (\d+)$/m.exec(metrics)?.[1]);
}

// Subscribes to person_detected without results, and causes an event.
async function event_comes(page: Page, world = hall): Promise<void> {
  await page.getByRole('treeitem', { name: /^person_detection / }).click();
  await page.getByRole('tab', { name: /^Events(?! and)/ }).click();
  await page.getByLabel('Include results').uncheck();
  await page.getByRole('button', { name: 'Subscribe', exact: true }).click();
  await page.locator('.exchange-came').getByText('OK', { exact: true }).waitFor();
  await command(page, 'person_detection', world);
  await world.pass_until(page, event_row(page), 200);
}

describe('events and messages', () => {
  test('are listed, filtered and read; a request leads to its answer', () =>
    stage.page(async (page) => {
      await command(page, 'person_detection');
      await row(page, /completed.*person_detection start/).waitFor();
      await row(page, 'execute_response').waitFor();
      await row(page, 'bind_response').getByText('person_detection', { exact: true }).waitFor();
      await page.getByLabel('Search in the text').fill('component_status');
      await page.getByText('No document matches the filter').waitFor();
      await page.getByLabel("Show the console's own requests").check();
      await row(page, 'query_response').first().waitFor();
      await page.getByLabel("Show the console's own requests").uncheck();
      await page.getByLabel('Search in the text').fill('');

      await row(page, /execute(?!_)/).click();
      const reader = page.getByRole('region', { name: 'Document: execute', exact: true });
      expect(await reader.textContent()).toContain('person_detection');
      expect(await reader.locator('.xml-name').count()).toBeGreaterThan(3); // coloured
      await page.getByRole('button', { name: 'Show answer' }).click();
      await page.getByRole('heading', { name: 'execute_response' }).waitFor();
      await page.getByRole('button', { name: 'Show request' }).click();
      await page.getByRole('heading', { name: 'execute', exact: true }).waitFor();
      await page.getByLabel('As transmitted').check();
      expect(await page.getByRole('region', { name: 'Document: execute', exact: true }).locator('.xml-line').count()).toBe(1);
      await picture(page, 'messages');
      expect(await violations(page)).toBe('');

      await kind(page, 'Requests').click();
      expect(await row(page, /execute(?!_)/).count()).toBe(0);
      await kind(page, 'Requests').click();
      await page.getByLabel('Component', { exact: true }).selectOption('navigation');
      await page.getByText('No document matches the filter').waitFor();
      await page.getByRole('button', { name: 'Show all', exact: true }).click();
      await page.getByLabel('Search in the text').fill('command_id');
      await row(page, 'completed').waitFor();
      await page.getByLabel('Search in the text').fill('');

      // By keyboard.
      await page.getByRole('listbox').focus();
      await page.keyboard.press('End');
      await page.keyboard.press('ArrowUp');
      await page.locator('.messages .virtual-list-row[aria-selected=true]').waitFor();
    }));

  test('"Why" of a failed drive shows its end, even if the filter hides it', () =>
    stage.page(async (page) => {
      await page.getByLabel('Search in the text').fill('nothing has this text');
      await page.getByText('No document matches the filter').waitFor();
      await page.getByLabel('Place to go to').selectOption('desk');
      await page.getByLabel('Place', { exact: true }).selectOption('Point on the floor');
      await page.getByLabel('x', { exact: true }).fill('17.5');
      await page.getByLabel('y', { exact: true }).fill('7');
      await page.getByRole('button', { name: 'Send here' }).click();
      const why = page.getByRole('region', { name: 'Notices' }).getByRole('button', { name: 'Why' });
      await hall.pass_until(page, why);
      await why.click();
      await page.getByRole('heading', { name: 'completed', exact: true }).waitFor();
      await page.locator('.messages .virtual-list-row[aria-selected=true]', { hasText: 'completed' }).waitFor();
      expect(await page.getByLabel('Search in the text').inputValue()).toBe('');
    }));

  test('an event without results has its details fetched', () =>
    stage.page(async (page) => {
      await event_comes(page);
      await event_row(page).first().click();
      await page.getByRole('button', { name: 'Fetch the details' }).click();
      await page.getByRole('region', { name: 'Details' }).getByText('number').waitFor();
      await picture(page, 'messages-event');
      expect(await violations(page)).toBe('');
    }));

  test('an expired event is marked, and its details are no longer available', async () => {
    const forgetful = await Stage.set(...still_hall, '--event-details', '0.1');
    const world = await Hall.of(forgetful);
    await forgetful.page(
      async (page) => {
        await event_comes(page, world);
        await event_row(page).first().getByText('expired').waitFor();
        await event_row(page).first().click();
        await page.getByRole('button', { name: 'Fetch the details' }).click();
        await page.getByText('The details are no longer available.').waitFor();
        await page.getByText(/expired/, { exact: false }).first().waitFor();
        await picture(page, 'messages-expired');
        expect(await violations(page)).toBe('');
      },
      {},
      stage.path,
    );
    await world.close();
    await forgetful.strike();
  });

  test('leave no error if the list is removed while scrolling', () =>
    stage.page(
      async (page) => {
        await page.getByLabel("Show the console's own requests").check();
        await page.locator('.virtual-list').evaluate((list) => list.dispatchEvent(new Event('scroll')));
        await page.evaluate(() => {
          const list = document.querySelector('.virtual-list')!;
          (document.querySelector('[role=tab]') as HTMLElement).click(); // the floor map
          requestAnimationFrame(() => requestAnimationFrame(() => list.dispatchEvent(new Event('scroll'))));
        });
        await page.locator('.virtual-list').waitFor({ state: 'detached' });
        await page.setViewportSize(sizes.wide);
        await page.getByRole('tab', { name: 'Components', exact: true }).waitFor();
      },
      sizes.tablet,
    ));

  test('the list can be paused', () =>
    stage.page(async (page) => {
      await page.getByText("Only the console's own requests so far").waitFor();
      await page.getByRole('button', { name: 'Pause', exact: true }).click();
      await command(page, 'person_detection');
      expect(await row(page, 'completed').count()).toBe(0);
      await page.getByRole('button', { name: /^Continue \(\d+ new\)$/ }).click();
      await row(page, 'completed').waitFor();
    }));

  test('a gap is shown at its place', () =>
    stage.page(
      async (page) => {
        await command(page, 'person_detection');
        stage.front.cut(); // for longer than the session is kept
        await page.getByText('Connection lost', { exact: true }).waitFor();
        await expect.poll(sessions, { timeout: 10_000 }).toBe(1); // the hall's
        stage.front.restore();
        await page.getByText('The session was lost and a new one began.', { exact: false }).waitFor();
        await page.getByText('The old session was lost', { exact: false }).waitFor();
        await picture(page, 'messages-gap');
        expect(await violations(page)).toBe('');
      },
      { may_complain: broken_link },
    ));

  test('a recording is exported, served by rois replay, and opened again, not live', () =>
    stage.page(async (page) => {
      await command(page, 'person_detection');
      await row(page, 'completed').waitFor();
      const [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: 'Export' }).click()]);
      expect(download.suggestedFilename()).toMatch(/^rois-.*\.jsonl$/);
      const file = resolve(tmpdir(), `console-${process.pid}.jsonl`);
      await download.saveAs(file);
      await answers_as_recorded(file);

      await page.getByLabel('Open a recording').last().setInputFiles(file);
      await page.getByText('Not live.').first().waitFor();
      await row(page, 'get_profile').first().waitFor();
      await page.getByLabel('Search in the text').fill('</completed>');
      await row(page, 'completed').click();
      await page.getByRole('heading', { name: 'completed' }).waitFor();
      expect(await page.getByRole('button', { name: 'Pause' }).count()).toBe(0);
      await picture(page, 'messages-recording');
      expect(await violations(page)).toBe('');
      await page.getByRole('button', { name: 'Back to live' }).click();
      await page.getByRole('button', { name: 'Pause' }).waitFor();

      await writeFile(file, '{"recording":"rois-recording-1"}\n{"at":0}\n');
      await page.getByLabel('Open a recording').last().setInputFiles(file);
      const trouble = page.getByText("line 2: 'at' (a number) or 'document' (a text) is missing");
      await trouble.waitFor();
      const [below, above] = await Promise.all([page.getByRole('alert').boundingBox(), page.locator('#panels').boundingBox()]);
      expect(below!.y + below!.height, 'covers nothing').toBeLessThanOrEqual(above!.y);
      await writeFile(file, '{"recording":"rois-recording-1"}\n{"at":0,"direction":"out","document":"<connect/>"}\n{"at":1,"dire');
      await page.getByLabel('Open a recording').last().setInputFiles(file);
      await page.getByText('The last line of the recording is incomplete and was ignored.').waitFor();
      expect(await trouble.count()).toBe(0);
    }));

  test.each(looks)('look well and are accessible: %s, %s, %s', (size, look, language) =>
    stage.page(
      async (page) => {
        await page.locator('.messages input[type=checkbox]').first().check();
        await page.locator('.messages input[type=search]').fill('get_profile'); // however many documents have arrived
        await row(page, 'get_profile').first().click();
        await page.getByRole('heading', { name: /get_profile/ }).waitFor();
        expect(await violations(page)).toBe('');
        await picture(page, `messages-${size}-${look}-${language}`);
      },
      { ...sizes[size], look, language, touch: size !== 'wide' },
    ),
  );
});

// The file as an engine: recorded commands are answered and completed as before.
function answers_as_recorded(file: string): Promise<void> {
  return replayed(file, async (url) => {
    const client = await connect(url);
    expect((await client.get_profile()).components.map((one) => one.ref)).toContain('navigation');
    await client.bind('person_detection');
    const execution = await client.execute([start('person_detection', 'start')]);
    expect(await execution.status()).toBe('OK');
    await client.close();
  });
}
