// The floor map: drawing, sending and stopping the robot, following, observing; by mouse, touch and keyboard.
import type { Locator, Page } from 'playwright-core';
import { connect } from 'rois-client';
import { beforeEach, describe, expect, test } from 'vitest';

import type { Console } from '../../src/state/console';
import { click_map, on_map } from './floor';
import { type Hall, set_still_hall } from './hall';
import { broken_link, is_in_view, picture, sizes, type Stage, violations } from './harness';

let stage: Stage;
let hall: Hall;

set_still_hall(async (...both) => {
  [stage, hall] = both;
  await hall.pass(1000);
});

/** The row of a thing in the table for screen readers. */
const row = (page: Page, name: string | RegExp) => page.locator('.map table tbody tr').filter({ has: page.getByRole('rowheader', { name }) });
const scale = (page: Page) => page.locator('.map-scale').getAttribute('aria-label');
const ready = (page: Page) => row(page, 'robot1').getByText('Now').waitFor();

async function observe(page: Page): Promise<void> {
  await page.getByRole('switch', { name: 'Observe' }).click();
  await page.getByText('5 components work').waitFor();
  await page.locator('.map-switch[aria-busy="false"]').waitFor();
}
const pass_until = (page: Page, shown: Locator, step?: number) => hall.pass_until(page, shown, step);

describe('the map', () => {
  test.each([
    ['wide', 'dark', 'en'],
    ['tablet', 'light', 'ja'],
  ] as const)('shows the hall and its robot, with frame and scale: %s, %s, %s', (size, look, language) =>
    stage.page(
      async (page) => {
        await page.getByRole('heading', { name: 'Reception hall' }).waitFor();
        await row(page, 'robot1').waitFor();
        expect(await row(page, 'robot1').textContent()).toMatch(/x 6\.\d\d? m.\s?y (5\.9|6\.0)/);
        expect(await scale(page)).toMatch(/[12] m$/);
        await page.locator('.map-frame', { hasText: 'hall' }).waitFor();
        expect(await violations(page)).toBe('');
        await picture(page, `map-${size}-${look}-${language}`);
      },
      { ...sizes[size], look, language, touch: size !== 'wide' },
    ),
  );

  test('is not drawn at rest, and the time line once a second, while positions arrive', () =>
    stage.page(
      async (page) => {
        await ready(page);
        const counted = await page.evaluate(async () => {
          const { rois } = window as unknown as { rois: Console };
          const drawn = { map: 0, timeline: 0, seconds: -1, positions: 0 };
          const proto = CanvasRenderingContext2D.prototype;
          const { drawImage, clearRect } = proto;
          proto.drawImage = function (this: CanvasRenderingContext2D, ...given: unknown[]) {
            drawn.map += Number(this.canvas.className === 'map-canvas');
            (drawImage as (...given: unknown[]) => void).apply(this, given);
          } as typeof drawImage;
          proto.clearRect = function (this: CanvasRenderingContext2D, ...given) {
            drawn.timeline += Number(this.canvas.className === 'timeline-canvas');
            clearRect.apply(this, given);
          };
          rois.now.subscribe(() => (drawn.seconds += 1));
          for (let reported_at = 0; drawn.positions < 10; await new Promise((looked) => setTimeout(looked, 20))) {
            const { at } = rois.robots.all.get('robot1')!;
            drawn.positions += Number(at !== reported_at);
            reported_at = at;
          }
          return drawn;
        });
        expect(counted.map).toBe(0);
        expect(counted.timeline).toBeLessThanOrEqual(counted.seconds + 1);
      },
      { motion: 'no-preference' },
    ));

  test('is an empty grid if the engine has no map', () =>
    stage.page(
      async (page) => {
        await page.route('**/rois/map', (route) => route.fulfill({ status: 404, body: '' }));
        await page.reload();
        await page.getByText('This engine has no map; showing an empty grid').waitFor();
        await ready(page);
        expect(await scale(page)).toMatch(/m$/);
        await picture(page, 'map-none');
      },
      { may_complain: broken_link }, // the first link may still be opening when the page is loaded again
    ));

  test('shows the age of its data when the link is lost', () =>
    stage.page(
      async (page) => {
        await ready(page);
        stage.front.cut();
        await page.getByText(/^Not live: as it was \d+ s ago$/).waitFor();
        await row(page, 'robot1').getByText('No news').waitFor();
        expect(await violations(page)).toBe('');
        await picture(page, 'map-lost');
        stage.front.restore();
        await ready(page);
        await page.getByText(/^Not live/).waitFor({ state: 'detached' });
      },
      { may_complain: broken_link },
    ));

  test('is zoomed by wheel and buttons, panned by dragging, and fitted again', () =>
    stage.page(async (page) => {
      await ready(page);
      const whole = await scale(page);
      const desk = await on_map(page, { x: 9500, y: 9300 });
      await page.mouse.move(desk.x, desk.y);
      await page.mouse.wheel(0, -900);
      await page.waitForFunction((before) => document.querySelector('.map-scale')!.getAttribute('aria-label') !== before, whole);
      await page.locator('.map-pointer', { hasText: /x 9\.(49|50) m, y 9\.(29|30) m|x 9\.5\d? m, y 9\.3/ }).waitFor(); // the point under the pointer stays
      await page.mouse.down();
      await page.mouse.move(desk.x - 150, desk.y + 60, { steps: 4 });
      await page.mouse.up();
      await page.locator('.map-pointer', { hasText: /x 9\.(49|5\d?) m, y 9\.(29|3\d?) m/ }).waitFor();
      expect(await page.getByText('Send robot1').count()).toBe(0);
      await page.getByRole('button', { name: 'Show the whole floor' }).click();
      await page.waitForFunction((before) => document.querySelector('.map-scale')!.getAttribute('aria-label') === before, whole);
      await page.getByRole('button', { name: 'Larger' }).click({ clickCount: 4 });
      await page.waitForFunction((before) => document.querySelector('.map-scale')!.getAttribute('aria-label') !== before, whole);
    }));

  test('is zoomed by two fingers and panned by one, and a tap is a click', () =>
    stage.page(
      async (page) => {
        await ready(page);
        const whole = await scale(page);
        const at = await on_map(page, { x: 9000, y: 5000 });
        const touches = await page.context().newCDPSession(page);
        const touch = (type: 'touchStart' | 'touchMove' | 'touchEnd', ...points: number[]) =>
          touches.send('Input.dispatchTouchEvent', { type, touchPoints: points.map((x, id) => ({ x: at.x + x, y: at.y, id })) });
        await touch('touchStart', -40);
        await touch('touchStart', -40, 40);
        for (const apart of [60, 90, 120, 160]) await touch('touchMove', -apart, apart);
        await touch('touchEnd');
        await page.waitForFunction((before) => document.querySelector('.map-scale')!.getAttribute('aria-label') !== before, whole);
        expect(await page.getByRole('heading', { name: 'Send robot1' }).count()).toBe(0);
        await page.getByRole('button', { name: 'Show the whole floor' }).click();
        await touch('touchStart', 0);
        for (const moved of [20, 40, 60]) await touch('touchMove', moved);
        await touch('touchEnd');
        await page.touchscreen.tap(at.x + 60, at.y); // the floor has moved with the finger
        await page.getByRole('heading', { name: 'Send robot1' }).waitFor();
        expect(await page.locator('.map-fact code').textContent()).toMatch(/^(89[5-9]\d|90[0-4]\d|9000), (49[5-9]\d|50[0-4]\d|5000)$/);
        expect(await violations(page)).toBe('');
        await picture(page, 'map-touch');
      },
      { ...sizes.small, touch: true },
    ));
});

describe('the robot', () => {
  test('is sent to a point with a direction, which is previewed, and arrives', () =>
    stage.page(async (page) => {
      await ready(page);
      await click_map(page, { x: 4000, y: 4000 });
      await page.getByText(/^\d\.\d m away/).waitFor();
      const from = await on_map(page, { x: 4000, y: 4000 });
      await page.mouse.move(from.x, from.y);
      await page.mouse.down();
      await page.mouse.move(from.x, from.y - 80, { steps: 4 });
      await page.mouse.up();
      await page.locator('.map-fact code', { hasText: /, 90$/ }).waitFor();
      await picture(page, 'map-preview');
      expect(await violations(page)).toBe('');
      await page.getByRole('button', { name: 'Cancel', exact: true }).click();
      // Both at once.
      await page.keyboard.down('Shift');
      await page.mouse.move(from.x, from.y);
      await page.mouse.down();
      await page.mouse.move(from.x, from.y - 80, { steps: 4 });
      await page.mouse.up();
      await page.keyboard.up('Shift');
      await page.locator('.map-fact code', { hasText: /^(39|40)\d\d, (39|40)\d\d, 90$/ }).waitFor();
      await page.getByRole('button', { name: 'Send here' }).click();
      await page.locator('.map-motion').getByText(/^robot1 → x [34]\.\d\d m/).waitFor();
      await page.getByRole('button', { name: 'Stop robot1' }).waitFor();
      await pass_until(page, row(page, 'robot1').getByText(/x [45]\.[2-9]/), 200);
      await picture(page, 'map-going');
      expect(await violations(page)).toBe('');
      await pass_until(page, page.getByText(/^robot1 has reached/));
      await row(page, 'robot1').getByText(/^(8[6-9]|9[0-4])°$/).waitFor();
      await page.getByText('0 bound').waitFor();
    }));

  test('is stopped by the button beside its motion', () =>
    stage.page(async (page) => {
      await ready(page);
      await page.getByLabel('Place to go to').selectOption('exhibit');
      await page.getByRole('button', { name: 'Send here' }).click();
      await hall.pass(2000);
      await page.locator('.map-motion').getByRole('button', { name: 'Stop robot1' }).click();
      await pass_until(page, page.getByText('robot1 was stopped'), 100);
      expect(await page.getByText(/has reached/).count()).toBe(0);
      await page.getByText('0 bound').waitFor();
    }));

  test('speaks a sentence from its card, which leads to its other commands', () =>
    stage.page(async (page) => {
      await ready(page);
      await page.getByRole('button', { name: 'Table' }).click();
      await page.getByRole('button', { name: 'Choose: robot1' }).click();
      const card = page.getByRole('region', { name: 'Robot robot1' });
      // Another language was set for an earlier speech, and the component is still bound.
      await page.evaluate(async () => {
        const { rois } = window as unknown as { rois: Console };
        await rois.set_parameter('speech_synthesis', { language: 'ja' });
      });
      await card.getByRole('textbox', { name: 'Speak' }).fill('Welcome.');
      await page.keyboard.press('Enter');
      await page.getByText('1 bound').waitFor();
      const spoken = () => page.evaluate(() => (window as unknown as { rois: Console }).rois.commands.all.list().filter((one) => one.command_type === 'start').map((one) => one.arguments.map(({ name, values }) => `${name}=${values.join()}`)));
      await expect.poll(spoken).toEqual([['speech_text=Welcome.', 'volume=50', 'language=en', 'character=default']]);
      await hall.pass(3000);
      await expect.poll(() => page.evaluate(() => (window as unknown as { rois: Console }).rois.commands.all.list().filter((one) => one.command_type === 'start').map((one) => `${one.component} ${one.state}`))).toEqual(['speech_synthesis OK']);
      await page.evaluate(() => (window as unknown as { rois: Console }).rois.bindings.release('speech_synthesis'));
      await page.getByText('0 bound').waitFor();
      await card.getByText('All commands').click();
      await card.getByRole('button', { name: 'reaction', exact: true }).click();
      await page.getByRole('heading', { name: 'reaction', exact: true }).waitFor();
      expect(await violations(page)).toBe('');
      await page.getByRole('button', { name: 'Table' }).click();
    }));

  test('is sent to a place by name', () =>
    stage.page(async (page) => {
      await ready(page);
      await page.getByLabel('Place to go to').selectOption('desk');
      await page.locator('.map-fact code', { hasText: /^desk$/ }).waitFor();
      await page.getByRole('button', { name: 'Send here' }).click();
      await page.getByText('robot1 → desk').waitFor();
      await pass_until(page, page.getByText('robot1 has reached desk'));
      await row(page, 'robot1').getByText(/x 9\.[45]\d m, y 9\.[23]\d m/).waitFor();
    }));

  test("is not sent to an impossible place without a warning; the engine's reason is shown", () =>
    stage.page(async (page) => {
      await ready(page);
      await click_map(page, { x: 9000, y: 10_600 });
      await page.getByText('Furniture is in the way here.').waitFor();
      await page.getByRole('button', { name: 'Send here' }).click();
      await pass_until(page, page.getByText(/^Not reached:/));
      const notice = page.getByRole('alert').filter({ hasText: /is outside of the hall, in a wall or in furniture/ });
      await notice.waitFor();
      expect(await violations(page)).toBe('');
      await notice.getByRole('button', { name: /^Why/ }).click();
      await page.locator('.panel-messages').getByRole('option', { selected: true }).getByText('completed').waitFor();
    }));

  test('is sent by keyboard alone', () =>
    stage.page(async (page) => {
      await ready(page);
      await page.getByRole('application', { name: /^Floor map/ }).focus();
      for (const key of ['Shift+ArrowLeft', 'Shift+ArrowLeft', 'ArrowDown', 'Enter', 'q']) await page.keyboard.press(key);
      await page.getByRole('status').filter({ hasText: /^x 8\.00 m, y 5\.75 m/ }).waitFor();
      await page.locator('.map-fact code', { hasText: /^8000, 5750, -?\d+$/ }).waitFor();
      await picture(page, 'map-keys');
      await page.keyboard.press('Control+Enter');
      await pass_until(page, page.getByText('robot1 has reached x 8.00 m, y 5.75 m'));
      await page.keyboard.press('Escape');
      await page.keyboard.press('n');
      await page.getByRole('heading', { name: 'Robot robot1' }).waitFor();
      await page.keyboard.press('Escape');
      await page.getByRole('heading', { name: 'Robot robot1' }).waitFor({ state: 'detached' });
    }));
});

describe('the card of a target', () => {
  test.each(['wide', 'small', 'phone'] as const)('leaves the target and its button visible, and restores the focus: %s', (size) =>
    stage.page(
      async (page) => {
        await ready(page);
        for (const at of [{ x: 2000, y: 2000 }, { x: 18_000, y: 2000 }, { x: 18_000, y: 7000 }]) {
          await click_map(page, at);
          const send = page.getByRole('button', { name: 'Send here' });
          await send.waitFor();
          expect(await is_in_view(send)).toBe(true);
          const point = await on_map(page, at);
          expect(await page.evaluate(({ x, y }) => document.elementFromPoint(x, y)?.className, point)).toBe('map-canvas');
          await page.getByRole('button', { name: 'Cancel' }).click();
          await send.waitFor({ state: 'detached' });
          expect(await page.evaluate(() => document.activeElement?.className)).toBe('map-canvas');
        }
        expect(await violations(page)).toBe('');
        await picture(page, `map-card-${size}`);
      },
      { ...sizes[size], touch: size !== 'wide' },
    ),
  );
});

describe('people', () => {
  let is_there = false;
  beforeEach(async () => {
    if (!is_there) await hall.visit('tanaka', '11000, 5750, 180', { known: true });
    is_there = true;
  });

  test('appear with their identity while the engine observes, and components are released afterwards', () =>
    stage.page(async (page) => {
      await ready(page);
      expect(await row(page, /tanaka|person-/).count()).toBe(0);
      await observe(page);
      await page.getByText('5 bound').waitFor();
      // Identification needs a person who is near and faces the robot.
      await page.getByLabel('Place to go to').selectOption('start');
      await page.getByRole('button', { name: 'Send here' }).click();
      await pass_until(page, page.getByText('robot1 has reached start'));
      await hall.walk('tanaka', '8000, 6000, 180');
      await pass_until(page, row(page, /tanaka/), 200);
      await pass_until(page, row(page, /tanaka person-\d/).getByText(/x (7\.[89]|8\.[0-2])\d m, y (5\.[89]|6\.[0-2])/), 200);
      const trails = await page.evaluate(() => [...(window as unknown as { rois: Console }).rois.entities.all.values()].filter((one) => one.kind === 'person').map((one) => one.trail.size));
      expect(trails.every((points) => points > 1), `trails of ${trails.join(', ')} points`).toBe(true);
      await hall.say('tanaka', 'Good morning, is anybody there? I have come for the meeting at ten.');
      await pass_until(page, row(page, /^sound-/), 200);
      await page.getByRole('button', { name: 'Table' }).click();
      await page.getByRole('button', { name: 'Choose: tanaka' }).click();
      await page.getByText(/^Tracked as person-\d/).waitFor();
      await page.getByText(/^± 0\.12 m \(95 %\)$/).first().waitFor();
      expect(await violations(page)).toBe('');
      await picture(page, 'map-people');
      await page.getByRole('switch', { name: 'Observe' }).click();
      await page.getByText('0 bound').waitFor();
    }));

  test('stay on the map when the user subscribes to them without results, and the badge is correct', () =>
    stage.page(async (page) => {
      await ready(page);
      await observe(page);
      await pass_until(page, row(page, /tanaka|person-/), 200);
      await page.getByRole('treeitem', { name: /^person_localization / }).click();
      await page.getByRole('tab', { name: /^Events(?! and)/ }).click();
      await page.getByLabel('Include results').uncheck();
      await page.getByRole('button', { name: 'Subscribe', exact: true }).click();
      await page.locator('.exchange-came').getByText('OK', { exact: true }).waitFor();
      for (const x of [9, 8]) {
        await hall.walk('tanaka', `${x}000, 6000, 180`);
        await pass_until(page, row(page, /tanaka|person-/).getByText(new RegExp(`x (${x}\\.[0-3]|${x - 1}\\.[6-9])\\d m`)), 200);
      }
      await page.locator('.map').getByText(/5 components work, news 1 s ago/).waitFor();
      expect(await page.locator('.map').getByText('results do not arrive').count()).toBe(0);
      await page.getByRole('switch', { name: 'Observe' }).click();
      await page.getByText('0 bound').waitFor();
    }));

  test('can be visited from their card: the focus goes to the send button, and then to the map', () =>
    stage.page(async (page) => {
      await ready(page);
      await observe(page);
      await pass_until(page, row(page, /tanaka|person-/), 200);
      await page.getByRole('button', { name: 'Table' }).click();
      await page.getByRole('button', { name: /^Choose: (tanaka|person-)/ }).click();
      const focused = () => page.evaluate(() => document.activeElement?.textContent || document.activeElement?.className);
      await page.getByRole('button', { name: 'Go there' }).press('Enter');
      await expect.poll(focused).toBe('Send here');
      await page.keyboard.press('Enter');
      await page.locator('.map-motion').waitFor();
      await expect.poll(focused).toBe('map-canvas');
      await pass_until(page, page.getByText(/robot1 has reached (tanaka|person-)/));
      await page.getByRole('button', { name: 'Table' }).click();
      await page.getByRole('switch', { name: 'Observe' }).click();
      await page.getByText('0 bound').waitFor();
    }));

  test('are followed until the user stops the command', () =>
    stage.page(
      async (page) => {
        await ready(page);
        await observe(page);
        await pass_until(page, row(page, /tanaka|person-/), 200);
        await hall.walk('tanaka', '12000, 4000, 180');
        await page.getByRole('application', { name: /^Floor map/ }).focus();
        await page.keyboard.press('n');
        const person = page.getByRole('region', { name: /^Person/ });
        await person.waitFor();
        await page.getByLabel('Distance to keep').fill('-1');
        await page.getByText('Enter a number above 0').waitFor();
        await page.getByLabel('Distance to keep').fill('1.5');
        await person.getByRole('button', { name: 'Follow' }).click();
        await page.locator('.map-motion', { hasText: /robot1 follows/ }).waitFor();
        await person.waitFor({ state: 'detached' }); // it no longer covers anything
        await page.getByRole('application', { name: /^Floor map/ }).focus();
        await page.keyboard.press('n');
        await pass_until(page, person.getByText(/robot1 1\.[3-7] m away/));
        await picture(page, 'map-follow');
        expect(await violations(page)).toBe('');
        await page.locator('.map-motion').getByRole('button', { name: 'Stop robot1' }).click();
        await pass_until(page, page.locator('.notices').getByText(/no longer follows|was stopped/), 100);
        await page.getByText('5 bound').waitFor();
      },
      { look: 'light' },
    ));

  test('are observed again after a reload, until the user switches observing off', () =>
    stage.page(async (page) => {
      await ready(page);
      await observe(page);
      await page.reload();
      await page.getByText('5 components work').waitFor();
      await page.locator('.map-switch[aria-busy="false"]').waitFor();
      await page.getByRole('switch', { name: 'Observe' }).click();
      await page.getByText('0 bound').waitFor();
      await page.reload();
      await ready(page);
      expect(await page.getByRole('switch', { name: 'Observe' }).getAttribute('aria-checked')).toBe('false');
    }));

  test('are drawn as gone after they have left, and then removed', () =>
    stage.page(async (page) => {
      await ready(page);
      await observe(page);
      await pass_until(page, row(page, /tanaka|person-/), 200);
      await hall.leave('tanaka');
      is_there = false;
      await pass_until(page, row(page, /tanaka|person-/).getByText('Out of sight'), 500);
    }));

  test('are unknown, not out of sight, while the link is lost and when nothing observes', () =>
    stage.page(
      async (page) => {
        await ready(page);
        await hall.visit('ueno', 'desk');
        await observe(page);
        const anybody = row(page, /ueno|person-/).first();
        await pass_until(page, anybody, 200);
        stage.front.cut();
        await anybody.getByText('Unknown').waitFor();
        await page.locator('.map-bar').getByText('not connected', { exact: true }).waitFor();
        expect(await page.locator('.map-bar').getByText(/components work/).count()).toBe(0);
        stage.front.restore();
        await ready(page);
        await page.getByText('5 components work').waitFor();
        await page.getByRole('switch', { name: 'Observe' }).click();
        await anybody.getByText('Unknown').waitFor();
        expect(await page.getByText('Out of sight').count()).toBe(0);
        await hall.leave('ueno');
      },
      { may_complain: broken_link },
    ));

  test('are observed as far as other applications allow', async () => {
    const other = await connect(stage.gateway.url);
    await other.bind('person_localization');
    await stage.page(async (page) => {
      await ready(page);
      await page.getByRole('switch', { name: 'Observe' }).click();
      await page.getByText('4 of 5 components work').waitFor();
      await page.getByText('Some things cannot be observed').click();
      await page.getByText(/person_localization: .*Another application has bound it/).waitFor();
      expect(await violations(page)).toBe('');
    });
    await other.close();
  });
});
