// The static layer: floor, grid, walls, furniture, places and frames. Redrawn only when the view changes.
import type { Bounds, FloorMap, Place } from '../../state/floor/floor_map';
import { round_step, to_floor } from '../view';
import type { Pen } from './pen';

/** The layers that the user has switched on. */
export interface Layers {
  grid: boolean;
  places: boolean;
  frames: boolean;
  trails: boolean;
  certainty: boolean;
  faces: boolean;
  sounds: boolean;
  names: boolean;
}

export const all_layers: Layers = {
  grid: true,
  places: true,
  frames: true,
  trails: true,
  certainty: true,
  faces: true,
  sounds: true,
  names: true,
};

const least_cell = 22; // px
const wall_width = 90; // mm
const name_below = 10; // px
const line_height = 14; // px

export function draw_ground(pen: Pen, map: FloorMap | undefined, layers: Layers): void {
  const { context, size, palette } = pen;
  context.fillStyle = map ? palette.ground : palette.panel;
  context.fillRect(0, 0, size.width, size.height);
  if (!map) {
    if (layers.grid) draw_grid(pen);
    return draw_axes(pen, { x: 0, y: 0, heading: 0, name: '' });
  }
  box(pen, map.bounds, () => pen.fill(palette.panel));
  context.save();
  box(pen, map.bounds, () => context.clip());
  if (layers.grid) draw_grid(pen);
  if (layers.places) for (const place of map.places) draw_area(pen, place);
  context.restore();
  for (const piece of map.furniture)
    box(pen, piece, () => {
      pen.fill(palette.furniture);
      pen.stroke(palette.wall, 1, 0.55);
    });
  draw_walls(pen, map);
  const names: Name[] | undefined = layers.names ? [] : undefined;
  if (layers.places) for (const place of map.places) draw_place(pen, place, names);
  if (!layers.frames) return;
  for (const frame of frames_of(map)) draw_axes(pen, frame);
}

/** A frame of reference in the map's frame. */
export interface Axes {
  x: number;
  y: number;
  heading: number;
  name: string;
}

export function frames_of(map: FloorMap): Axes[] {
  const own = map.robots.flatMap(({ frame }) => (frame ? [{ ...frame, name: short_name(frame.crs) }] : []));
  return [{ x: 0, y: 0, heading: 0, name: short_name(map.crs) }, ...own];
}

/** The last part of a frame's name. */
export function short_name(crs: string): string {
  return crs.slice(crs.lastIndexOf(':') + 1);
}

/** Width of a grid cell in mm. */
function grid_step(scale: number): number {
  return round_step(least_cell / scale);
}

function draw_grid(pen: Pen): void {
  const { context, size, view, palette } = pen;
  const step = grid_step(view.scale);
  const [low, high] = [to_floor(view, size, { x: 0, y: size.height }), to_floor(view, size, { x: size.width, y: 0 })];
  for (const is_major of [false, true]) {
    context.beginPath();
    const lines = (from: number, to: number, draw: (at: number) => void) => {
      for (let n = Math.ceil(from / step); n * step <= to; ++n) if ((n % 5 === 0) === is_major) draw(n * step);
    };
    lines(low.x, high.x, (x) => {
      const at = Math.round(pen.at({ x, y: 0 }).x) + 0.5;
      context.moveTo(at, 0);
      context.lineTo(at, size.height);
    });
    lines(low.y, high.y, (y) => {
      const at = Math.round(pen.at({ x: 0, y }).y) + 0.5;
      context.moveTo(0, at);
      context.lineTo(size.width, at);
    });
    pen.stroke(is_major ? palette.line : palette.grid, 1);
  }
}

function box(pen: Pen, { x, y, width, depth }: Bounds, draw: () => void): void {
  const corner = pen.at({ x, y: y + depth });
  pen.context.beginPath();
  pen.context.rect(corner.x, corner.y, pen.length(width), pen.length(depth));
  draw();
}

function draw_walls(pen: Pen, { walls, bounds: { x, y, width, depth } }: FloorMap): void {
  const { context, palette } = pen;
  const corners = [{ x, y }, { x: x + width, y }, { x: x + width, y: y + depth }, { x, y: y + depth }].map((one) => pen.at(one));
  context.lineCap = 'square';
  context.lineJoin = 'miter';
  context.beginPath();
  for (const corner of corners) context.lineTo(corner.x, corner.y);
  context.closePath();
  for (const { x1, y1, x2, y2 } of walls) {
    const [from, to] = [pen.at({ x: x1, y: y1 }), pen.at({ x: x2, y: y2 })];
    context.moveTo(from.x, from.y);
    context.lineTo(to.x, to.y);
  }
  pen.stroke(palette.wall, Math.max(2, pen.length(wall_width)));
}

// The area of a place, as used in conditions.
function draw_area(pen: Pen, { x, y, width, depth }: Place): void {
  pen.dashed(3, 4);
  box(pen, { x: x - width / 2, y: y - depth / 2, width, depth }, () => {
    pen.fill(pen.palette.place, 0.22);
    pen.stroke(pen.palette.place, 1);
  });
  pen.dashed();
}

// Centre of a written name, in px.
interface Name {
  x: number;
  y: number;
  half: number; // of its width
}

// Omits a name that would overlap one of `names` until the user zooms in; undefined: shows no names.
function draw_place(pen: Pen, place: Place, names: Name[] | undefined): void {
  const { context, palette } = pen;
  const at = pen.at(place);
  pen.turned(at, place.heading, () => {
    pen.arrow(11, 7, 3.5);
    pen.fill(palette.soft);
  });
  pen.circle(at, 3.5);
  pen.fill(palette.panel);
  pen.stroke(palette.soft, 1.5);
  if (!names) return;
  context.font = palette.font;
  context.textBaseline = 'top';
  const half = context.measureText(place_name(place)).width / 2 + 2;
  if (names.some((one) => Math.abs(one.x - at.x) < one.half + half && Math.abs(one.y - at.y) < line_height)) return;
  names.push({ ...at, half });
  pen.text(place_name(place), { x: at.x, y: at.y + name_below }, palette.soft, 'center');
}

/** With spaces instead of underscores. */
export function place_name({ name }: Place): string {
  return name.replaceAll('_', ' ');
}

/** The box of a place's name; other labels avoid it. */
export function name_box(pen: Pen, place: Place, width: number): { x: number; y: number; width: number; height: number } {
  const at = pen.at(place);
  return { x: at.x - width / 2, y: at.y + name_below - 2, width, height: 16 };
}

/** The box of a frame's name, beside its origin and inside the screen. */
export function frame_box(pen: Pen, frame: Axes, width: number): { x: number; y: number; width: number; height: number } {
  const at = pen.at(frame);
  const room = pen.size.width - 8 - width;
  return {
    x: at.x > pen.size.width ? at.x + 8 : Math.min(at.x + 8, room),
    y: at.y + 12 < pen.size.height - 6 ? at.y + 4 : at.y - 20,
    width,
    height: 16,
  };
}

function draw_axes(pen: Pen, frame: Axes): void {
  const { context, palette } = pen;
  const at = pen.at(frame);
  for (const [turn, letter, side] of [[0, 'x', 1], [90, 'y', -1]] as const) {
    pen.turned(at, frame.heading + turn, () => {
      pen.line({ x: 0, y: 0 }, { x: 30, y: 0 });
      pen.stroke(palette.ink, 1.5, 0.75);
      pen.arrow(36, 7, 3.5);
      pen.fill(palette.ink, 0.75);
    });
    const angle = ((frame.heading + turn) * Math.PI) / 180;
    context.font = palette.font;
    context.textBaseline = 'middle';
    // Beside its arrow, on the inner side: a wall may lie along the outer side.
    const [along, beside] = [36, 10 * side];
    pen.text(
      letter,
      { x: at.x + along * Math.cos(angle) - beside * Math.sin(angle), y: at.y - along * Math.sin(angle) - beside * Math.cos(angle) },
      palette.soft,
      'center',
    );
  }
  pen.circle(at, 2.5);
  pen.fill(palette.ink, 0.75);
  if (frame.name === '') return;
  const box = frame_box(pen, frame, context.measureText(frame.name).width);
  pen.text(frame.name, { x: box.x, y: box.y + 8 }, palette.soft);
}
