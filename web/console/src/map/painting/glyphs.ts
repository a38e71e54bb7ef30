// Symbols of robots, persons, faces and sounds from above. They differ in shape, not only in colour.
import type { Kind, Shown } from '../scene';
import type { Point } from '../view';
import type { Palette } from './palette';
import type { Pen } from './pen';

/** In standard deviations: 95 % of a two-dimensional normal distribution lie inside. */
export const confidence = 2.4477;
const least: Record<Kind, number> = { robot: 10, person: 10, face: 4, sound: 5 }; // px
const gone = [3, 3];

export function color_of(kind: Kind, palette: Palette): string {
  return palette[kind];
}

/** The drawn radius in pixels. */
export function radius_of(pen: Pick<Pen, 'length'>, { kind, radius }: Pick<Shown, 'kind' | 'radius'>): number {
  return Math.max(least[kind], pen.length(radius));
}

export function draw_thing(pen: Pen, thing: Shown, at: Point): void {
  const radius = radius_of(pen, thing);
  const style = color_of(thing.kind, pen.palette);
  if (/gone|old|unknown/.test(thing.freshness)) pen.dashed(...gone);
  if (thing.kind === 'robot') draw_robot(pen, thing, at, radius, style);
  else if (thing.kind === 'person') draw_person(pen, thing, at, radius, style);
  else if (thing.kind === 'face') draw_face(pen, thing, at, radius, style);
  else draw_sound(pen, thing, at, radius, style);
  pen.dashed();
}

// With a ring if it acts for a logical component.
function draw_robot(pen: Pen, { th, freshness, acts_for = [] }: Shown, at: Point, radius: number, style: string): void {
  const { context, palette } = pen;
  if (acts_for.length > 0) {
    pen.circle(at, radius + 4);
    pen.stroke(palette.path, 2);
  }
  pen.circle(at, radius);
  pen.fill(freshness === 'gone' ? palette.panel : style, freshness === 'gone' ? 0.8 : 1);
  pen.stroke(style, 2);
  if (th === undefined) return;
  pen.turned(at, th, () => {
    context.beginPath();
    context.moveTo(radius * 0.72, 0);
    context.lineTo(-radius * 0.45, -radius * 0.52);
    context.lineTo(-radius * 0.18, 0);
    context.lineTo(-radius * 0.45, radius * 0.52);
    context.closePath();
    pen.fill(freshness === 'gone' ? style : palette.panel);
  });
}

// Shoulders and head, with a nose in the viewing direction. Filled if identified.
function draw_person(pen: Pen, { th, freshness, identity }: Shown, at: Point, radius: number, style: string): void {
  const { context, palette } = pen;
  const alpha = /gone|old|unknown/.test(freshness) ? 0 : identity ? 1 : 0.45;
  pen.turned(at, th ?? 0, () => {
    if (th !== undefined) {
      pen.arrow(radius * 1.55, radius * 0.8, radius * 0.42);
      pen.fill(style, freshness === 'gone' ? 0.5 : 1);
    }
    context.beginPath();
    if (th === undefined) context.arc(0, 0, radius, 0, 2 * Math.PI);
    else context.ellipse(0, 0, radius * 0.62, radius, 0, 0, 2 * Math.PI);
    pen.fill(palette.panel, 0.9);
    if (alpha > 0) pen.fill(style, alpha);
    pen.stroke(style, 1.5, freshness === 'live' ? 1 : 0.75);
  });
  pen.circle(at, radius * 0.44);
  pen.fill(palette.panel, freshness === 'gone' ? 0.6 : 1);
  pen.stroke(style, 1.5, freshness === 'live' ? 1 : 0.75);
}

// A diamond with a viewing direction.
function draw_face(pen: Pen, { th, freshness }: Shown, at: Point, radius: number, style: string): void {
  const { context } = pen;
  if (th !== undefined)
    pen.turned(at, th, () => {
      context.beginPath();
      context.moveTo(0, 0);
      context.arc(0, 0, Math.max(26, pen.length(900)), -0.26, 0.26);
      context.closePath();
      pen.fill(style, freshness === 'live' ? 0.28 : 0.12);
    });
  context.beginPath();
  context.moveTo(at.x + radius, at.y);
  context.lineTo(at.x, at.y + radius);
  context.lineTo(at.x - radius, at.y);
  context.lineTo(at.x, at.y - radius);
  context.closePath();
  if (freshness !== 'gone') pen.fill(style);
  pen.stroke(style, 1);
}

// Waves around a point.
function draw_sound(pen: Pen, { freshness }: Shown, at: Point, radius: number, style: string): void {
  pen.circle(at, radius * 0.6);
  if (freshness !== 'gone') pen.fill(style);
  pen.stroke(style, 1);
  for (const n of [1, 2, 3]) {
    pen.context.beginPath();
    pen.context.arc(at.x, at.y, radius * (0.6 + n * 0.8), -0.7, 0.7);
    pen.context.moveTo(at.x - radius * (0.6 + n * 0.8) * Math.cos(0.7), at.y + radius * (0.6 + n * 0.8) * Math.sin(0.7));
    pen.context.arc(at.x, at.y, radius * (0.6 + n * 0.8), Math.PI - 0.7, Math.PI + 0.7);
    pen.stroke(style, 1.8, (freshness === 'gone' ? 0.5 : 1) / n + 0.15);
  }
}

/** The ellipse of 95 % certainty, if it is larger than the symbol. */
export function draw_certainty(pen: Pen, { ellipse, kind }: Shown, at: Point): void {
  if (!ellipse) return;
  const [a, b] = [pen.length(ellipse.a * confidence), pen.length(ellipse.b * confidence)];
  if (a < 2) return;
  const style = color_of(kind, pen.palette);
  pen.turned(at, ellipse.angle, () => {
    pen.context.beginPath();
    pen.context.ellipse(0, 0, a, Math.max(b, 0.5), 0, 0, 2 * Math.PI);
    pen.fill(style, 0.12);
    pen.stroke(style, 1, 0.7);
  });
}

export function draw_choice(pen: Pen, at: Point, radius: number): void {
  pen.circle(at, radius + 7);
  pen.stroke(pen.palette.panel, 5, 0.8);
  pen.circle(at, radius + 7);
  pen.stroke(pen.palette.accent, 2);
}
