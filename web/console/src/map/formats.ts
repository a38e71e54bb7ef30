// Formats numbers of the floor.
import { duration } from '../i18n/i18n';
import type { Target } from './interaction';
import { confidence } from './painting/glyphs';
import type { Shown } from './scene';
import * as texts from './texts';

/** `4.20 m`; below a metre `0.25 m`. */
export function metres(mm: number, digits = 2): string {
  const written = (mm / 1000).toFixed(digits);
  return texts.metres(Number(written) === 0 ? (0).toFixed(digits) : written);
}

/** `x 4.20 m, y 3.00 m` */
export function position(at: { x: number; y: number }): string {
  const number = (mm: number) => metres(mm).replace(/\s*m$/, '');
  return texts.at(number(at.x), number(at.y));
}

/** `90°`: counter-clockwise from the x axis. */
export function degrees(th: number): string {
  return texts.degrees(Math.round(th).toFixed(0).replace(/^-0$/, '0'));
}

/** In seconds below 10 s, then in steps of 5 s, because a changed label redraws the map. */
export function age(ms: number): string {
  const step = ms < 10_000 ? 1000 : 5000;
  return duration(Math.max(1000, Math.floor(ms / step) * step)).replace('.0', '');
}

/** `± 0.12 m (95 %)`, for both axes if they differ. */
export function certainty(ellipse: { a: number; b: number }): string {
  const [a, b] = [metres(ellipse.a * confidence), metres(ellipse.b * confidence)];
  return texts.certain(a === b ? a : `${a} × ${b}`);
}

/** The logical components for which a robot acts. */
export function acts_text({ acts_for = [] }: Shown): string {
  return acts_for.join(', ');
}

/** A target in words: a place or person by name, else the position. */
export function target_words(target: Target): string {
  return target.place ?? target.whom ?? position(target);
}
