// The states of the link as shown to the user, each provoked with the real gateway.
import { createHash } from 'node:crypto';
import { rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { resolve } from 'node:path';

import type { Page } from 'playwright-core';
import { command, connect } from 'rois-client';
import { afterAll, afterEach, beforeAll, describe, expect, test } from 'vitest';

import { Hall, still_hall } from './hall';
import { broken_link, picture, Stage, violations } from './harness';
import { replayed } from './replay';

const expected = { may_complain: broken_link };

let browser: Stage; // exists all the time, so that one browser serves all tests
let stage: Stage;
beforeAll(async () => {
  browser = await Stage.set(...still_hall);
});
afterEach(() => stage.strike());
afterAll(() => browser.strike());

const said = (page: Page, text: string | RegExp) => page.getByRole('status').filter({ hasText: text }).first();
const mark = (page: Page, phase: string) => page.locator('.link-mark').getByText(phase, { exact: true });

async function check_page(page: Page, name: string): Promise<void> {
  expect(await violations(page)).toBe('');
  await picture(page, `link-${name}`);
}

describe('the link', () => {
  test('shows that the gateway does not answer yet', async () => {
    stage = await Stage.set(...still_hall);
    stage.front.cut();
    await stage.page(async (page) => {
      await said(page, 'The gateway does not answer yet.').waitFor();
      await mark(page, 'Connecting').waitFor();
      await check_page(page, 'connecting');
      stage.front.restore();
      await mark(page, 'Connected').waitFor();
      await said(page, 'The gateway does not answer yet.').waitFor({ state: 'detached' });
    }, expected);
  });

  test('shows a gap after a resumed link', async () => {
    stage = await Stage.set(...still_hall, '--max-waiting-notifications', '16');
    const hall = await Hall.of(stage);
    const other = await connect(stage.gateway.url);
    stage.path = '/#messages';
    await stage.page(async (page) => {
      await page.getByRole('treeitem', { name: /^person_detection / }).click();
      await page.getByRole('tab', { name: /^Events(?! and)/ }).click();
      await page.getByRole('button', { name: 'Subscribe', exact: true }).click();
      await page.locator('.exchange-came').getByText('OK', { exact: true }).waitFor();
      stage.front.cut();
      await mark(page, 'Connection lost').waitFor();
      await said(page, /The data is .* old/).waitFor();
      await check_page(page, 'lost');

      await other.bind('person_detection');
      for (let i = 0; i < 20; ++i)
        for (const type of ['start', 'stop']) await hall.pass_while((await other.execute([command('person_detection', type)])).status(), 100);
      stage.front.restore();
      await mark(page, 'Connected again').waitFor();
      await said(page, /\d notifications were missed while disconnected\./).waitFor();
      const gap = page.getByText(/The engine dropped/).first();
      for (const list = page.locator('.virtual-list'); !(await gap.isVisible()); ) await list.press('ArrowUp'); // documents follow it
      await check_page(page, 'gap');
      await page.getByRole('button', { name: 'Seen' }).click();
      await said(page, /were missed/).waitFor({ state: 'detached' });
    }, expected);
    await other.close();
    await hall.close();
  });

  test('shows that the gateway refuses a further session', async () => {
    stage = await Stage.set(...still_hall, '--max-sessions', '1');
    const other = await connect(stage.gateway.url);
    await stage.page(async (page) => {
      await mark(page, 'Refused').waitFor();
      await said(page, /refuses this console/).waitFor();
      await check_page(page, 'refused');
      await other.close();
      await mark(page, 'Connected').waitFor();
    }, expected);
  });

  test('a token is requested, and requested again if it is wrong or revoked', async () => {
    const file = resolve(tmpdir(), `rois-tokens-${process.pid}.json`);
    const sha256 = createHash('sha256').update('open-sesame').digest('hex');
    const allow = (...tokens: object[]) => writeFile(file, JSON.stringify({ tokens }));
    await allow({ name: 'console', role: 'operator', sha256 });
    stage = await Stage.set(...still_hall, '--tokens', file);
    await stage.page(async (page) => {
      const dialog = page.getByRole('dialog', { name: 'This gateway requires a token' });
      await dialog.waitFor();
      await check_page(page, 'token');
      await page.getByRole('textbox', { name: 'Token' }).fill('sesame');
      await page.keyboard.press('Enter');
      await page.getByText('The gateway did not accept this token.').waitFor();
      await check_page(page, 'token-wrong');
      await page.getByRole('textbox', { name: 'Token' }).fill('open-sesame');
      await page.getByRole('button', { name: 'Connect', exact: true }).click();
      await mark(page, 'Connected').waitFor();
      await page.getByRole('treeitem', { name: /^navigation / }).getByText('READY').waitFor();
      await allow();
      await dialog.waitFor();
    }, expected);
    await rm(file);
  });

  test('shows that the gateway shuts down, and then the lost link', async () => {
    stage = await Stage.set(...still_hall);
    await stage.page(async (page) => {
      await page.getByRole('treeitem', { name: /^navigation / }).click();
      await page.getByLabel('target_position, item 1').fill('exit');
      await page.getByRole('button', { name: 'start', exact: true }).last().click();
      await page.locator('.exchange-came').getByText('Running.').waitFor();
      stage.front.is_draining = true;
      const stopped = stage.gateway.stop();
      await mark(page, 'Starting or stopping').waitFor();
      await said(page, 'The gateway is starting or shutting down.').waitFor();
      await page.locator('.exchange-came').getByText(/^Aborted: /).waitFor();
      await stopped;
      await check_page(page, 'draining');
      // When the gateway is gone, the link is lost; old data does not look live, and the user need not wait for the next retry.
      stage.front.is_draining = false;
      await page.getByRole('button', { name: 'Try now' }).click();
      await mark(page, 'Connection lost').waitFor();
      const asked: string[] = [];
      page.on('request', (request) => asked.push(new URL(request.url()).pathname));
      await page.getByRole('button', { name: 'Try now' }).click();
      await expect.poll(() => asked).toContain('/rois');
      expect(asked).not.toContain('/metrics');
    }, expected);
  });

  test('shows that the engine has no components', async () => {
    stage = await Stage.set(...still_hall);
    const file = resolve(tmpdir(), `empty-${process.pid}.jsonl`);
    const names = 'xmlns:rois="http://www.omg.org/spec/RoIS/20240801" xmlns:gml="http://www.opengis.net/gml/3.2"';
    const answer = `<get_profile_response xmlns="urn:x-rois:psm:xml:message:1" return_code="OK"><rois:HRIEngineProfile ${names} gml:id="engine.bare"><gml:identifier codeSpace="urn:ietf:rfc:2141">urn:x-rois:def:HRIEngine:Example::bare</gml:identifier><gml:name>bare</gml:name></rois:HRIEngineProfile><components/></get_profile_response>`;
    const lines = [{ recording: 'rois-recording-1' }, { at: 0, direction: 'out', document: '<get_profile xmlns="urn:x-rois:psm:xml:message:1"/>' }, { at: 0, direction: 'in', document: answer }];
    await writeFile(file, lines.map((line) => `${JSON.stringify(line)}\n`).join(''));
    await replayed(file, async (url) => {
      stage.front.gateway = url;
      await stage.page(async (page) => {
        await said(page, 'This engine has no components.').waitFor();
        await page.getByText('bare', { exact: true }).first().waitFor();
        await check_page(page, 'empty');
      }, expected);
    });
    await rm(file);
  });
});
