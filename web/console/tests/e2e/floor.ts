// Points of the reception hall's floor in mm, converted to the page.
import type { Page } from 'playwright-core';

import { fitted, margin_of, type Point, to_screen } from '../../src/map/view';

const bounds = { x: 0, y: 0, width: 20_000, depth: 12_000 };

/** The position of a point on the floor map, which shows the whole floor. */
export async function on_map(page: Page, at: Point): Promise<Point> {
  const box = (await page.locator('.map-canvas').boundingBox())!;
  const point = to_screen(fitted(bounds, box, margin_of(box)), box, at);
  return { x: box.x + point.x, y: box.y + point.y };
}

export async function click_map(page: Page, at: Point): Promise<void> {
  const point = await on_map(page, at);
  await page.mouse.click(point.x, point.y);
}

/** Drags on the map of a condition. */
export async function drag_area(page: Page, from: Point, to: Point): Promise<void> {
  const svg = page.locator('.conditions-picker svg');
  await svg.scrollIntoViewIfNeeded();
  const on_page = ({ x, y }: Point) =>
    svg.evaluate((one: SVGSVGElement, [mm_x, mm_y]) => {
      const { x: left, y: top } = new DOMPoint(mm_x, -mm_y!).matrixTransform(one.getScreenCTM()!);
      return [left, top] as const;
    }, [x, y]);
  await page.mouse.move(...(await on_page(from)));
  await page.mouse.down();
  await page.mouse.move(...(await on_page(to)), { steps: 4 });
  await page.mouse.up();
}
