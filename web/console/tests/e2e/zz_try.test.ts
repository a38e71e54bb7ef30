import { afterAll, beforeAll, test } from 'vitest';
import type { Page } from 'playwright-core';
import { picture, Stage, violations } from './harness';
let stage: Stage;
beforeAll(async () => { stage = await Stage.set('--sim-speed', '4', '--seed', '7'); });
afterAll(() => stage.strike());
async function busy(page: Page) {
  await page.getByText('Connected', { exact: true }).waitFor();
  await page.locator('.timeline-name-component').first().waitFor();
  await page.evaluate(async () => {
    const rois = (window as any).rois;
    for (const [ref, ev] of [['person_localization','person_localized'],['person_detection','person_detected'],['speech_recognition','speech_recognized'],['face_detection','face_detected']]) {
      await rois.subscribe(ev, {inline_results: true}); await rois.run(ref, 'start').catch((e: any) => console.log(e)); }
    for (let i = 0; i < 3; ++i) {
      await rois.run('speech_synthesis', 'start', { speech_text: 'Hello, this is number ' + i }).catch(() => 0);
      await rois.run('navigation', 'start', { target_position: [['desk','exit','entrance'][i]] }, {}).catch(() => 0);
      await new Promise((r) => setTimeout(r, 3500));
      await rois.run('navigation', 'start', { target_position: ['100000, 4'] }, {}).catch(() => 0);
      if (i === 1) await rois.bindings.release('speech_synthesis');
    }
    await rois.run('move', 'start').catch(() => 0);
  });
}
for (const [name, o] of Object.entries({
  'wide-dark': { width: 1600, height: 1000, look: 'dark' as const },
  'wide-light': { width: 1600, height: 1000, look: 'light' as const, language: 'ja' as const },
  'tablet-dark': { width: 1024, height: 768, look: 'dark' as const, touch: true },
  'upright-light': { width: 820, height: 1180, look: 'light' as const, touch: true },
})) if (!process.env.ONLY || process.env.ONLY.split(',').includes(name)) test(name, () => stage.page(async (page) => {
  await busy(page);
  await picture(page, `try-${name}`);
  const box = (await page.locator('.timeline-canvas').boundingBox())!;
  await page.locator('.timeline-place').focus();
  for (const key of ['ArrowDown', 'ArrowDown', 'ArrowLeft', 'ArrowLeft']) await page.keyboard.press(key);
  await picture(page, `try-${name}-keys`);
  await page.keyboard.press('Enter');
  await page.locator('.timeline-details').waitFor();
  await picture(page, `try-${name}-details`);
  await page.mouse.move(box.x + 120, box.y + 90);
  console.log(name, await violations(page));
  await page.keyboard.press('Escape');
  await page.getByLabel('As a table').or(page.getByLabel('表で見る')).check();
  await picture(page, `try-${name}-table`);
  console.log(name, await violations(page));
}, o, '/#timeline'), 120000);
