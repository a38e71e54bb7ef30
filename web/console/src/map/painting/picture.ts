// The dynamic layer: things, goals and the user's target.
import { bearing, type FloorPose } from '../../state/floor/floor';
import type { Place } from '../../state/floor/floor_map';
import type { Goal } from '../goals';
import type { Target } from '../interaction';
import type { Shown } from '../scene';
import type { Point, Size } from '../view';
import { draw_certainty, draw_choice, draw_thing, radius_of } from './glyphs';
import { type Axes, frame_box, type Layers, name_box, place_name } from './ground';
import { type Label, Labels, type Place as LabelBox } from './labels';
import type { Pen } from './pen';

/** A robot at the target, before it is sent. */
export interface Preview {
  target: Target;
  radius: number; // mm
  from: Point | undefined;
  text: string; // `4.2 m`
  is_blocked: boolean;
}

export interface Picture {
  shown: readonly Shown[];
  /** The pose to draw. */
  pose(one: Shown): FloorPose;
  goals: readonly Goal[];
  /** Of the map. */
  places: readonly Place[];
  frames: readonly Axes[];
  layers: Layers;
  chosen: string | undefined;
  hovered: string | undefined;
  cursor: Point | undefined;
  preview: Preview | undefined;
  /** The age of an outdated thing: `12 s`. */
  age_text(ms: number): string;
}

const order = { face: 0, sound: 1, person: 2, robot: 3 };
/** Distance in px of the rotation handle from its target; shorter at the edge of the screen. */
export function knob_distance(radius: number, at: Point, th: number, { width, height }: Size): number {
  const angle = (th * Math.PI) / 180;
  const room = (before: number, all: number, way: number) => ((way > 0 ? all - before : before) - 9) / Math.max(Math.abs(way), 1e-9);
  return Math.max(20, Math.min(Math.max(46, radius + 26), room(at.x, width, Math.cos(angle)), room(at.y, height, -Math.sin(angle))));
}

export function draw_picture(pen: Pen, picture: Picture, labels: Labels): void {
  const { layers, chosen } = picture;
  const seen = picture.shown
    .filter((one) => (one.kind !== 'face' || layers.faces) && (one.kind !== 'sound' || layers.sounds))
    .sort((a, b) => order[a.kind] - order[b.kind])
    .map((one): [Shown, FloorPose, Point] => {
      const pose = picture.pose(one);
      return [{ ...one, ...pose }, pose, pen.at(pose)];
    });
  const place_of = new Map(seen.map(([one, , at]) => [one.key, at]));
  for (const goal of picture.goals) draw_goal(pen, goal, goal.robot && place_of.get(`robot ${goal.robot.ref}`));
  if (layers.certainty) for (const [one, , at] of seen) draw_certainty(pen, one, at);
  for (const [one, , at] of seen) {
    if (one.key === chosen) draw_choice(pen, at, radius_of(pen, one));
    draw_thing(pen, one, at);
  }
  if (layers.names) draw_names(pen, picture, seen, labels);
  if (picture.preview) draw_preview(pen, picture.preview);
  if (picture.cursor) draw_cursor(pen, pen.at(picture.cursor));
}

function draw_goal(pen: Pen, { x, y, th, kind, is_mine }: Goal, from: Point | undefined): void {
  const at = pen.at({ x, y });
  const alpha = is_mine ? 1 : 0.55;
  const { path, panel } = pen.palette;
  if (from) {
    pen.dashed(7, 5);
    pen.line(from, at);
    pen.stroke(path, 2, alpha);
    pen.dashed();
  }
  if (kind === 'follow') {
    pen.circle(at, 17);
    return pen.stroke(path, 2, alpha);
  }
  for (const [radius, style] of [[10, panel], [4, path]] as const) {
    pen.circle(at, radius);
    pen.fill(style, alpha);
    pen.stroke(path, 2, alpha);
  }
  if (th !== undefined) arrow(pen, at, th, 10, 20, path, alpha);
}

function arrow(pen: Pen, at: Point, th: number, from: number, to: number, style: string, alpha = 1): void {
  pen.turned(at, th, () => {
    pen.line({ x: from, y: 0 }, { x: to - 6, y: 0 });
    pen.stroke(style, 2, alpha);
    pen.arrow(to, 8, 4.5);
    pen.fill(style, alpha);
  });
}

function draw_preview(pen: Pen, { target, radius, from, text, is_blocked }: Preview): void {
  const { palette } = pen;
  const style = is_blocked ? palette.warning : palette.accent;
  const at = pen.at(target);
  const size = Math.max(10, pen.length(radius));
  if (from) {
    const start = pen.at(from);
    pen.dashed(4, 4);
    pen.line(start, at);
    pen.stroke(style, 1.5);
    pen.dashed();
    if (Math.hypot(start.x - at.x, start.y - at.y) > 90) pill(pen, text, { x: (start.x + at.x) / 2, y: (start.y + at.y) / 2 }, style);
  }
  pen.circle(at, size);
  pen.fill(style, 0.25);
  pen.dashed(5, 3);
  pen.stroke(style, 2);
  pen.dashed();
  const th = target.th ?? (from ? bearing(from, target) : 0);
  const knob = knob_distance(pen.length(radius), at, th, pen.size);
  pen.turned(at, th, () => {
    pen.line({ x: 0, y: 0 }, { x: knob - 7, y: 0 });
    pen.stroke(style, 2, target.th === undefined ? 0.6 : 1);
    pen.circle({ x: knob, y: 0 }, 7);
    pen.fill(target.th === undefined ? palette.panel : style);
    pen.stroke(style, 2);
  });
  pen.circle(at, 3);
  pen.fill(style);
}

function pill(pen: Pen, text: string, at: Point, style: string): void {
  const { context, palette } = pen;
  context.font = palette.font;
  context.textBaseline = 'middle';
  const width = context.measureText(text).width + 14;
  context.beginPath();
  context.roundRect(at.x - width / 2, at.y - 10, width, 20, 10);
  pen.fill(palette.raised);
  pen.stroke(style, 1);
  pen.text(text, { x: at.x, y: at.y + 1 }, palette.ink, 'center');
}

/** The thing's name, with its age unless it is current. */
export function label_of({ name, freshness, age }: Shown, age_text: (ms: number) => string): string {
  return freshness === 'live' ? name : `${name} · ${age_text(age)}`;
}

function draw_names(
  pen: Pen,
  { chosen, hovered, age_text, places: named, frames, layers }: Picture,
  seen: readonly [Shown, FloorPose, Point][],
  labels: Labels,
): void {
  const { context, palette, size } = pen;
  context.font = palette.font;
  context.textBaseline = 'middle';
  const texts = new Map<string, string>();
  const wanted: Label[] = [];
  for (const [one, , at] of seen) {
    const is_marked = one.key === chosen || one.key === hovered;
    if (one.kind !== 'robot' && one.kind !== 'person' && !is_marked) continue;
    const text = label_of(one, age_text);
    texts.set(one.key, text);
    wanted.push({
      key: one.key,
      width: Math.ceil(width_of(pen, text)) + 10,
      at,
      radius: radius_of(pen, one) * 1.3,
      must: is_marked || one.kind === 'robot',
    });
  }
  wanted.sort((a, b) => Number(b.must) - Number(a.must));
  const taken = layers.places ? named.map((place) => name_box(pen, place, width_of(pen, place_name(place)))) : [];
  if (layers.frames) for (const frame of frames) taken.push(frame_box(pen, frame, width_of(pen, frame.name)));
  for (const [one, , at] of seen) if (one.kind === 'robot' || one.kind === 'person') taken.push(box_of(at, radius_of(pen, one)));
  const places = labels.placed(wanted, size, taken);
  for (const [one] of seen) {
    const place = places.get(one.key);
    if (!place) continue;
    context.beginPath();
    context.roundRect(place.x, place.y, place.width, place.height, 4);
    pen.fill(palette.panel, 0.82);
    if (one.key === chosen) pen.stroke(palette.accent, 1);
    pen.text(
      texts.get(one.key)!,
      { x: place.x + 5, y: place.y + place.height / 2 + 1 },
      one.freshness === 'live' ? palette.ink : palette.soft,
    );
  }
}

function box_of({ x, y }: Point, radius: number): LabelBox {
  return { x: x - radius, y: y - radius, width: 2 * radius, height: 2 * radius };
}

const widths = new Map<string, number>();

function width_of({ context, palette }: Pen, text: string): number {
  const key = palette.font + text;
  const known = widths.get(key);
  if (known !== undefined) return known;
  if (widths.size > 500) widths.clear();
  const { width } = context.measureText(text);
  widths.set(key, width);
  return width;
}

function draw_cursor(pen: Pen, at: Point): void {
  for (const [style, width] of [[pen.palette.panel, 4], [pen.palette.ink, 2]] as const)
    for (const [x, y] of [[1, 0], [-1, 0], [0, 1], [0, -1]] as const) {
      pen.line({ x: at.x + 5 * x, y: at.y + 5 * y }, { x: at.x + 16 * x, y: at.y + 16 * y });
      pen.stroke(style, width);
    }
}

