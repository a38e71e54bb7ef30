// The visible part of the floor. Floor: mm, x to the right, y up. Screen: CSS pixels, y down.

import type { Point } from '../state/floor/floor';

export type { Point };
/** On the screen. */
export interface Size {
  width: number;
  height: number;
}
/** A rectangle on the floor, by its lower left corner. */
export interface Box extends Point {
  width: number;
  depth: number;
}
/** The point of the floor at the centre of the screen, and the scale in pixels per mm. */
export interface View extends Point {
  scale: number;
}

const least_scale = 0.001; // a kilometre on a wide screen
const greatest_scale = 0.5; // 2 mm a pixel

export function to_screen(view: View, size: Size, { x, y }: Point): Point {
  return { x: size.width / 2 + (x - view.x) * view.scale, y: size.height / 2 - (y - view.y) * view.scale };
}

export function to_floor(view: View, size: Size, { x, y }: Point): Point {
  return { x: view.x + (x - size.width / 2) / view.scale, y: view.y - (y - size.height / 2) / view.scale };
}

/** Moves the floor by this many pixels. */
export function panned(view: View, across: number, down: number): View {
  return { ...view, x: view.x - across / view.scale, y: view.y + down / view.scale };
}

/** Scales by a factor around a fixed point of the screen. */
export function zoomed(view: View, size: Size, at: Point, factor: number): View {
  const scale = Math.min(greatest_scale, Math.max(least_scale, view.scale * factor));
  const fixed = to_floor(view, size, at);
  return { x: fixed.x - (at.x - size.width / 2) / scale, y: fixed.y + (at.y - size.height / 2) / scale, scale };
}

/** Two fingers move two points of the floor. Does not rotate. */
export function pinched(view: View, size: Size, before: readonly [Point, Point], after: readonly [Point, Point]): View {
  const apart = ([a, b]: readonly [Point, Point]) => Math.max(1, Math.hypot(a.x - b.x, a.y - b.y));
  const [from, to] = [middle(before), middle(after)];
  return zoomed(panned(view, to.x - from.x, to.y - from.y), size, to, apart(after) / apart(before));
}

function middle([a, b]: readonly [Point, Point]): Point {
  return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 };
}

/** The whole box with a margin in pixels. */
export function fitted(box: Box, size: Size, margin: number): View {
  const room = (length: number) => Math.max(40, length - 2 * margin);
  const scale = Math.min(room(size.width) / Math.max(1, box.width), room(size.height) / Math.max(1, box.depth));
  return { x: box.x + box.width / 2, y: box.y + box.depth / 2, scale: Math.min(greatest_scale, Math.max(least_scale, scale)) };
}

/** The margin around a whole floor. */
export function margin_of({ width, height }: Size): number {
  return Math.min(36, 0.06 * Math.min(width, height));
}

/** Moves the view just enough to have the point on the screen, at least `margin` pixels from its edge. */
export function with_point(view: View, size: Size, point: Point, margin: number): View {
  const at = to_screen(view, size, point);
  const beyond = (to: number, length: number) => Math.max(0, margin - to) - Math.max(0, to - (length - margin));
  return panned(view, beyond(at.x, size.width), beyond(at.y, size.height));
}

/** The smallest value of 1, 2 or 5 times a power of ten that is at least `least`. */
export function round_step(least: number): number {
  const power = 10 ** Math.floor(Math.log10(least));
  return power * ([1, 2, 5, 10].find((one) => one * power >= least * 0.999999) ?? 10);
}

/** Multiples of 5 m around all points and the origin. */
export function box_around(points: Iterable<Point>): Box {
  const step = 5000;
  let [left, bottom, right, top] = [-step, -step, step, step];
  for (const { x, y } of points) {
    left = Math.min(left, Math.floor(x / step) * step);
    bottom = Math.min(bottom, Math.floor(y / step) * step);
    right = Math.max(right, Math.ceil(x / step) * step);
    top = Math.max(top, Math.ceil(y / step) * step);
  }
  return { x: left, y: bottom, width: right - left, depth: top - bottom };
}
