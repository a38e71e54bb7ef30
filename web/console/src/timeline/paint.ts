// Draws the layout.
import { type Sheet, time_marks, type Tone, tone_of } from '../ui';
import { type Box, type Layout, type Placed, x_of } from './layout';
import { began_at, has_failed, marks_tone, span_tone } from './things';
import type { Range } from './view';

/** Of the time axis. */
export const axis_height = 22;
const least_mark = 74; // px between two times

export interface Look {
  layout: Layout;
  scroll: number; // px, scroll position of the lanes
  at: number; // end of the known time: now, or when it was paused
  hovered: string | undefined; // keys
  opened: string | undefined;
  focused: string | undefined; // spot of the thing
  choice: Range | undefined; // range being selected
  phase_text: (phase: string) => string; // of the link
}

type Ink = ReturnType<typeof inks>;

function inks({ color }: Sheet) {
  const colors_of = (tone: Tone) =>
    tone === 'calm'
      ? { soft: color('--calm-soft'), full: color('--ink-soft') }
      : { soft: color(`--${tone}-soft`), full: color(`--${tone}`) };
  return {
    ink: color('--ink'),
    soft: color('--ink-soft'),
    line: color('--line'),
    grid: color('--draw-grid'),
    panel: color('--panel'),
    ground: color('--ground'),
    accent: color('--accent'),
    other: color('--draw-face'),
    event: color('--draw-sound'),
    chosen: color('--accent-soft'),
    on_accent: color('--ink-on-accent'),
    sans: color('--sans'),
    tones: {
      calm: colors_of('calm'),
      good: colors_of('good'),
      busy: colors_of('busy'),
      warning: colors_of('warning'),
      bad: colors_of('bad'),
    } satisfies Record<Tone, unknown>,
  };
}

export function paint(sheet: Sheet, look: Look): void {
  const { pen, width, height } = sheet;
  const { layout, scroll, choice } = look;
  const ink = inks(sheet);
  pen.textBaseline = 'middle';
  pen.save();
  pen.translate(0, axis_height - scroll);
  paint_ground(pen, look, ink, height);
  const below = [...layout.placed].sort((a, b) => order(a) - order(b));
  for (const one of below) if (one.box.y + one.box.height >= scroll && one.box.y <= scroll + height) paint_thing(pen, one, look, ink);
  for (const one of layout.placed) {
    if (one.key === look.opened || one.key === look.hovered) outline(pen, one.box, ink.ink);
    if (one.spot === look.focused) outline(pen, one.box, ink.accent);
  }
  pen.restore();
  if (choice) paint_choice(pen, choice, layout, ink, height);
  paint_axis(pen, look, ink, width, height);
}

// Marks lie above commands, commands above spans, as in hit tests.
function order({ thing }: Placed): number {
  return ['span', 'command', 'marks'].indexOf(thing.kind);
}

function paint_ground(pen: CanvasRenderingContext2D, { layout, at, scroll }: Look, ink: Ink, height: number): void {
  const { lanes, range, width } = layout;
  for (const { at: mark } of time_marks(range.from, range.to, marks_apart(layout)))
    line(pen, x_of(mark, range, width), scroll, height, ink.grid);
  pen.fillStyle = ink.line;
  for (const lane of lanes) pen.fillRect(0, lane.y + lane.height - 1, width, 1);
  // Hatches the times without a link, in which nothing was received.
  for (const { thing, box } of layout.placed)
    if (thing.kind === 'span' && thing.span.kind === 'link' && !/^(open|resumed)$/.test(thing.span.value))
      hatch(pen, { x: box.x, y: scroll, width: box.width, height }, ink.line);
  const [begin, end] = [x_of(layout.oldest, range, width), x_of(at, range, width)];
  pen.fillStyle = ink.ground;
  if (begin > 0) pen.fillRect(0, scroll, begin, height);
  if (end < width) pen.fillRect(end, scroll, width - end, height);
}

function paint_thing(pen: CanvasRenderingContext2D, placed: Placed, look: Look, ink: Ink): void {
  const { thing, box } = placed;
  if (thing.kind === 'span') {
    if (thing.span.kind === 'holder') return paint_holder(pen, box, thing.span.value, ink);
    const { soft, full } = ink.tones[span_tone(thing.span)];
    fill(pen, box, soft, 2);
    pen.fillStyle = full;
    pen.fillRect(box.x, box.y, Math.min(2, box.width), box.height);
    text_in(pen, thing.span.kind === 'link' ? look.phase_text(thing.span.value) : thing.span.value, box, full, ink.sans);
  } else if (thing.kind === 'command') paint_command(pen, placed, look, ink);
  else if (look.layout.lanes[placed.lane]!.kind === 'component') {
    // Higher for more marks.
    const high = Math.min(box.height, 4 + 2 * Math.log2(thing.marks.length));
    const tone = marks_tone(thing.marks);
    pen.fillStyle = tone === 'busy' ? ink.event : ink.tones[tone].full;
    pen.fillRect(box.x, box.y + box.height - high, Math.max(box.width, 2), high);
  } else paint_marks(pen, placed, ink);
}

function paint_holder(pen: CanvasRenderingContext2D, box: Box, value: string, ink: Ink): void {
  pen.fillStyle = value === 'me' ? ink.accent : ink.other;
  if (value === 'me') return pen.fillRect(box.x, box.y, box.width, 2);
  for (let x = box.x; x < box.x + box.width; x += 8) pen.fillRect(x, box.y, Math.min(5, box.x + box.width - x), 2);
}

// A thin line while it waits, a bar while it runs, a sign for how it ended.
function paint_command(pen: CanvasRenderingContext2D, { thing, box, lane }: Placed, { layout, at }: Look, ink: Ink): void {
  if (thing.kind !== 'command') return;
  const { entry } = thing;
  const has_ended = entry.ended_at !== undefined && entry.ended_at <= at;
  const began = began_at(entry);
  const start =
    began === undefined || began > at
      ? box.x + box.width
      : Math.max(box.x, Math.min(box.x + box.width - 2, x_of(began, layout.range, layout.width)));
  const { soft, full } = ink.tones[has_ended ? tone_of(entry.state) : began === undefined ? 'calm' : 'busy'];
  pen.fillStyle = full;
  const has_text = layout.lanes[lane]!.kind !== 'component'; // drawn above the line
  pen.fillRect(box.x, has_text ? box.y + box.height - 3 : box.y + box.height / 2 - 1, Math.max(0, start - box.x), 2);
  pen.fillRect(box.x, box.y + 1, 1, box.height - 2);
  const bar = { ...box, x: start, width: box.x + box.width - start };
  if (!has_text) return fill(pen, bar, full, 2);
  fill(pen, bar, soft, 3);
  pen.strokeStyle = full;
  if (bar.width > 2) pen.strokeRect(bar.x + 0.5, bar.y + 0.5, bar.width - 1, bar.height - 1);
  const sign = has_ended ? entry.state : '';
  // A command that failed at once has its sign beside it.
  if (sign !== '' && (bar.width > 14 || has_failed(entry)))
    sign_of_end(pen, sign, bar.x + bar.width + (bar.width > 14 ? -8 : 6), bar.y + bar.height / 2, full);
  const room = { ...box, width: box.width - (sign === '' ? 0 : 12) };
  text_in(
    pen,
    `${entry.component} ${entry.command_type}`,
    start - box.x > box.width / 2 ? { ...room, y: box.y - 1 } : { ...bar, width: room.x + room.width - bar.x },
    full,
    ink.sans,
  );
}

function sign_of_end(pen: CanvasRenderingContext2D, state: string, x: number, y: number, color: string): void {
  pen.strokeStyle = color;
  pen.lineWidth = 1.5;
  pen.beginPath();
  const tone = tone_of(state);
  if (tone === 'good') path(pen, [x - 3, y, x - 0.5, y + 2.5, x + 3.5, y - 3]);
  else if (tone === 'bad') {
    path(pen, [x - 3, y - 3, x + 3, y + 3]);
    path(pen, [x - 3, y + 3, x + 3, y - 3]);
  } else pen.rect(x - 2.5, y - 2.5, 5, 5);
  pen.stroke();
  pen.lineWidth = 1;
}

// One mark: a diamond, or a triangle for a problem. Several: a pill with their number.
function paint_marks(pen: CanvasRenderingContext2D, { thing, box }: Placed, ink: Ink): void {
  if (thing.kind !== 'marks') return;
  const { marks } = thing;
  const tone = marks_tone(marks);
  const color = tone === 'busy' ? ink.event : ink.tones[tone].full;
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  pen.fillStyle = color;
  if (marks.length > 1) {
    const text = marks.length > 999 ? '999+' : String(marks.length);
    pen.font = `600 10px ${ink.sans}`;
    const wide = Math.max(16, pen.measureText(text).width + 8);
    fill(pen, { x: x - wide / 2, y: y - 7, width: wide, height: 14 }, color, tone === 'busy' ? 7 : 2);
    pen.fillStyle = ink.panel;
    pen.textAlign = 'center';
    pen.fillText(text, x, y + 0.5);
    pen.textAlign = 'left';
    return;
  }
  pen.beginPath();
  if (tone === 'busy') path(pen, [x, y - 5, x + 5, y, x, y + 5, x - 5, y]);
  else path(pen, [x, y - 6, x + 6, y + 5, x - 6, y + 5]);
  pen.closePath();
  pen.fill();
}

function paint_choice(pen: CanvasRenderingContext2D, choice: Range, { range, width }: Layout, ink: Ink, height: number): void {
  const [from, to] = [x_of(choice.from, range, width), x_of(choice.to, range, width)];
  pen.globalAlpha = 0.35;
  pen.fillStyle = ink.chosen;
  pen.fillRect(from, 0, to - from, height);
  pen.globalAlpha = 1;
  line(pen, from, 0, height, ink.accent);
  line(pen, to, 0, height, ink.accent);
}

function paint_axis(pen: CanvasRenderingContext2D, { layout, at }: Look, ink: Ink, width: number, height: number): void {
  const { range } = layout;
  pen.fillStyle = ink.panel;
  pen.fillRect(0, 0, width, axis_height - 1);
  pen.fillStyle = ink.line;
  pen.fillRect(0, axis_height - 1, width, 1);
  pen.font = `11px ${ink.sans}`;
  pen.textAlign = 'center';
  for (const mark of time_marks(range.from, range.to, marks_apart(layout))) {
    const x = x_of(mark.at, range, width);
    pen.fillStyle = ink.line;
    pen.fillRect(Math.round(x), axis_height - 5, 1, 4);
    pen.fillStyle = ink.soft;
    const half = pen.measureText(mark.text).width / 2;
    if (x - half > 2 && x + half < width - 2) pen.fillText(mark.text, x, axis_height / 2 - 1);
  }
  pen.textAlign = 'left';
  const end = x_of(at, range, width);
  if (end <= width + 1) line(pen, Math.min(end, width - 1), axis_height - 6, height, ink.accent);
}

function marks_apart({ range, width }: Layout): number {
  return ((range.to - range.from) / width) * least_mark;
}

function outline(pen: CanvasRenderingContext2D, { x, y, width, height }: Box, color: string): void {
  pen.strokeStyle = color;
  pen.lineWidth = 2;
  pen.strokeRect(x - 2, y - 2, width + 4, height + 4);
  pen.lineWidth = 1;
}

function hatch(pen: CanvasRenderingContext2D, { x, y, width, height }: Box, color: string): void {
  pen.save();
  pen.beginPath();
  pen.rect(x, y, width, height);
  pen.clip();
  pen.strokeStyle = color;
  pen.beginPath();
  for (let at = Math.floor((x - height) / 8) * 8; at < x + width; at += 8) path(pen, [at, y + height, at + height, y]);
  pen.stroke();
  pen.restore();
}

function fill(pen: CanvasRenderingContext2D, { x, y, width, height }: Box, color: string, radius: number): void {
  pen.fillStyle = color;
  pen.beginPath();
  pen.roundRect(x, y, Math.max(0, width), height, Math.min(radius, width / 2));
  pen.fill();
}

function line(pen: CanvasRenderingContext2D, x: number, y: number, height: number, color: string): void {
  pen.fillStyle = color;
  pen.fillRect(Math.round(x), y, 1, height);
}

function path(pen: CanvasRenderingContext2D, points: number[]): void {
  for (let i = 0; i < points.length; i += 2) pen[i === 0 ? 'moveTo' : 'lineTo'](points[i]!, points[i + 1]!);
}

// Only if it fits, or nearly. Stays at the left edge while its box moves out.
function text_in(pen: CanvasRenderingContext2D, text: string, box: Box, color: string, family: string): void {
  const x = Math.max(box.x, 0) + 5;
  const room = box.x + box.width - x - 2;
  if (room < 18) return;
  pen.font = `10.5px ${family}`;
  const shown = shortened(pen, text, room);
  if (shown === '') return;
  pen.fillStyle = color;
  pen.fillText(shown, x, box.y + box.height / 2 + 0.5);
}

const widths = new Map<string, number>();

function width_of(pen: CanvasRenderingContext2D, text: string): number {
  const key = `${pen.font} ${text}`;
  let width = widths.get(key);
  if (width === undefined) {
    if (widths.size > 2000) widths.clear();
    width = pen.measureText(text).width;
    widths.set(key, width);
  }
  return width;
}

function shortened(pen: CanvasRenderingContext2D, text: string, room: number): string {
  if (width_of(pen, text) <= room) return text;
  const letters = Math.floor((text.length * room) / width_of(pen, text)) - 1;
  return letters < 3 ? '' : `${text.slice(0, letters)}…`;
}
