// Computes lanes and boxes from the sources and the shown range. Draws nothing.
import type { Span } from '../state/history';
import type { CommandEntry } from '../state/session/commands_state';
import { end_of, first_since, oldest_of, type Rows, type Sources } from './sources';
import { has_failed, key_of, type Mark, mark_ref, type Thing } from './things';
import type { Range } from './view';

/** In CSS pixels: x from the left edge of the chart, y from the top of all lanes. */
export interface Box {
  x: number;
  y: number;
  width: number;
  height: number;
}

export interface Placed {
  thing: Thing;
  key: string; // of the thing
  spot: string; // of the thing in its lane: a command is in two lanes
  lane: number; // index
  box: Box;
}

export type LaneKind = 'link' | 'commands' | 'events' | 'component';

export interface Lane {
  kind: LaneKind;
  ref: string; // of a component
  y: number;
  height: number;
}

export interface Layout {
  range: Range;
  oldest: number; // the oldest known time
  width: number;
  height: number; // of all lanes
  lanes: Lane[];
  /** Later ones lie on top. */
  placed: Placed[];
}

export interface LayoutOptions {
  width: number;
  /** Omits components that only exist. */
  hides_quiet: boolean;
  /** Includes events of the console's own subscriptions. */
  with_own: boolean;
}

const heights = { link: 20, row: 18, events: 32, component: 30 };
const most_rows = 6; // rows of simultaneous commands; the last row takes the rest
/** Nearer marks are combined. The boundaries depend only on time, so that nothing flickers while the chart moves. */
const together = { events: 34, component: 7 }; // px

export function x_of(at: number, { from, to }: Range, width: number): number {
  return ((at - from) / (to - from)) * width;
}

export function time_of(x: number, { from, to }: Range, width: number): number {
  return from + (x / width) * (to - from);
}

export function lay_out(sources: Sources, range: Range, { width, hides_quiet, with_own }: LayoutOptions): Layout {
  const spans = spans_in(sources, range);
  const commands = [...sources.commands].filter((one) => one.sent_at <= range.to && (one.ended_at ?? sources.at) >= range.from);
  const marks = marks_in(sources, range, with_own);
  const rows = rows_of(sources.commands);
  const only = hides_quiet ? loud(spans, commands, marks) : undefined;
  const lanes = lanes_of(sources.refs.filter((ref) => !only || only.has(ref)), rows.count);
  const by_ref = new Map(lanes.map((lane, index) => [lane.kind === 'component' ? lane.ref : ` ${lane.kind}`, index]));
  const placed: Placed[] = [];

  const place = (thing: Thing, lane: number, box: Box) => {
    const key = key_of(thing);
    placed.push({ thing, key, spot: `${lanes[lane]!.kind} ${key}`, lane, box });
  };
  const put = (thing: Thing, lane: number | undefined, from: number, to: number, top: number, height: number, least = 1) => {
    if (lane === undefined) return;
    const x = Math.max(-4, x_of(from, range, width));
    const end = Math.min(width + 4, x_of(to, range, width));
    place(thing, lane, { x, y: lanes[lane]!.y + top, width: Math.max(least, end - x), height });
  };

  for (const { span, to } of spans) {
    const thing: Thing = { kind: 'span', span };
    if (span.kind === 'link') put(thing, by_ref.get(' link'), span.from, to, 4, 12);
    else if (span.kind === 'status') put(thing, by_ref.get(span.ref), span.from, to, 2, 13);
    else put(thing, by_ref.get(span.ref), span.from, to, 15, 3);
  }
  for (const entry of commands) {
    const thing: Thing = { kind: 'command', entry };
    const to = Math.min(entry.ended_at ?? sources.at, sources.at);
    put(thing, by_ref.get(entry.component), entry.sent_at, to, 20, 7, 3);
    put(thing, by_ref.get(' commands'), entry.sent_at, to, 3 + heights.row * (rows.of.get(entry) ?? 0), heights.row - 4, 3);
  }
  const events_lane = by_ref.get(' events');
  const put_marks = (lane_marks: Mark[], lane: number | undefined, most: number, top: number, height: number, side: number) => {
    const length = ((range.to - range.from) / width) * most;
    for (const { marks: one, from, to } of clusters(lane_marks, length)) {
      // A number stands in the middle of its time bin, so that it does not overlap its neighbour.
      const middle = x_of(
        lane === events_lane && one.length > 1 ? (Math.floor(from / length) + 0.5) * length : (from + to) / 2,
        range,
        width,
      );
      const wide = one.length === 1 ? side : Math.max(side, x_of(to, range, width) - x_of(from, range, width));
      if (lane !== undefined)
        place({ kind: 'marks', marks: one }, lane, { x: middle - wide / 2, y: lanes[lane]!.y + top, width: wide, height });
    }
  };
  // A failed command already has its bar in the component's lane.
  for (const [ref, component_marks] of grouped(
    marks.filter((one) => one.kind !== 'failed'),
    mark_ref,
  ))
    if (ref !== '') put_marks(component_marks, by_ref.get(ref), together.component, 19, 9, 3);
  const [events, troubles] = [marks.filter((one) => one.kind === 'event'), marks.filter((one) => one.kind !== 'event')];
  put_marks(events, events_lane, together.events, 1, 14, 12);
  put_marks(troubles, events_lane, together.events, 17, 14, 14);
  return { range, oldest: oldest_of(sources), width, height: lanes.at(-1)!.y + lanes.at(-1)!.height, lanes, placed };
}

function lanes_of(refs: readonly string[], rows: number): Lane[] {
  const lanes: Lane[] = [];
  let y = 0;
  const add = (kind: LaneKind, height: number, ref = '') => {
    lanes.push({ kind, ref, y, height });
    y += height;
  };
  add('link', heights.link);
  add('commands', 4 + heights.row * rows);
  add('events', heights.events);
  for (const ref of refs) add('component', heights.component, ref);
  return lanes;
}

interface Lasting {
  span: Span;
  to: number;
}

function spans_in(sources: Sources, { from, to }: Range): Lasting[] {
  const found: Lasting[] = [];
  for (const span of sources.past) if (span.to >= from && span.from <= to) found.push({ span, to: span.to });
  for (const span of sources.present) {
    const end = end_of(span, true, sources.at);
    if (end >= from && span.from <= to) found.push({ span, to: end });
  }
  return found;
}

function marks_in(
  { commands, events, own_events, errors, switches, gaps, refused, at: until }: Sources,
  { from, to }: Range,
  with_own: boolean,
): Mark[] {
  const marks: Mark[] = [];
  const since = <T extends { at: number }>(rows: Rows<T>, mark_of: (entry: T) => Mark) => {
    for (let i = first_since(rows, (one) => one.at, from); i < rows.size; ++i) {
      const entry = rows.at(i)!;
      if (entry.at > to) return;
      marks.push(mark_of(entry));
    }
  };
  since(events, (entry) => ({ kind: 'event', entry }));
  if (with_own) since(own_events, (entry) => ({ kind: 'event', entry }));
  since(errors, (entry) => ({ kind: 'error', entry }));
  since(switches, (entry) => ({ kind: 'switched', entry }));
  since(gaps, (entry) => ({ kind: 'gap', entry }));
  since(refused, (entry) => ({ kind: 'refused', entry }));
  for (const command of commands) {
    const at = command.ended_at ?? Infinity;
    if (at >= from && at <= Math.min(to, until) && has_failed(command)) marks.push({ kind: 'failed', entry: { at, command } });
  }
  return marks.sort((a, b) => a.entry.at - b.entry.at);
}

export interface Cluster {
  marks: Mark[];
  from: number;
  to: number;
}

/** Groups marks, which are in order, by time bins of `length` ms. */
export function clusters(marks: readonly Mark[], length: number): Cluster[] {
  const found: Cluster[] = [];
  let bin = NaN;
  for (const mark of marks) {
    const { at } = mark.entry;
    const mark_bin = Math.floor(at / length);
    const last = found.at(-1);
    if (last && mark_bin === bin) {
      last.marks.push(mark);
      last.to = at;
    } else found.push({ marks: [mark], from: at, to: at });
    bin = mark_bin;
  }
  return found;
}

/** The row of each command, without overlaps and independent of the shown range. */
export function rows_of(commands: Rows<CommandEntry>): { of: Map<CommandEntry, number>; count: number } {
  const of = new Map<CommandEntry, number>();
  const last: CommandEntry[] = [];
  for (const entry of commands) {
    let row = last.findIndex((one) => one.ended_at !== undefined && one.ended_at <= entry.sent_at);
    if (row < 0) row = Math.min(last.length, most_rows - 1);
    last[row] = entry;
    of.set(entry, row);
  }
  return { of, count: Math.max(1, last.length) };
}

/** Components with more than the status READY. */
function loud(spans: Lasting[], commands: CommandEntry[], marks: Mark[]): ReadonlySet<string> {
  const spoken = spans
    .filter(({ span }) => span.kind === 'holder' || !/^(READY|UNINITIALIZED)$/.test(span.value))
    .map(({ span }) => span.ref);
  return new Set([...spoken, ...commands.map((one) => one.component), ...marks.map(mark_ref)]);
}

function grouped<T>(list: readonly T[], key_of_one: (one: T) => string): Map<string, T[]> {
  const groups = new Map<string, T[]>();
  for (const one of list) {
    const group = groups.get(key_of_one(one));
    if (group) group.push(one);
    else groups.set(key_of_one(one), [one]);
  }
  return groups;
}

const least_hit = 12; // px, both sides together

/** The topmost thing at a point. Small things have a margin, unless another thing is there. */
export function thing_at({ placed }: Layout, x: number, y: number): Placed | undefined {
  const hit = (least: number, counts: (one: Placed) => boolean) => {
    for (let i = placed.length - 1; i >= 0; --i) {
      const one = placed[i]!;
      const { box } = one;
      const [wide, high] = [Math.max(0, least - box.width) / 2, Math.max(0, least - box.height) / 2];
      if (counts(one) && x >= box.x - wide && x <= box.x + box.width + wide && y >= box.y - high && y <= box.y + box.height + high)
        return one;
    }
    return undefined;
  };
  const is_span = ({ thing }: Placed) => thing.kind === 'span';
  return hit(0, (one) => !is_span(one)) ?? hit(least_hit, (one) => !is_span(one) && one.box.width < least_hit) ?? hit(0, is_span);
}

/** The target of an arrow key: along the lane, or the nearest in time in the next lane with things. */
export function next_thing(
  { lanes, placed }: Layout,
  from: Placed | undefined,
  key: 'ArrowLeft' | 'ArrowRight' | 'ArrowUp' | 'ArrowDown',
): Placed | undefined {
  const in_lane = (lane: number) => placed.filter((one) => one.lane === lane).sort((a, b) => a.box.x - b.box.x || a.box.y - b.box.y);
  if (!from) return placed.length === 0 ? undefined : in_lane(Math.min(...placed.map((one) => one.lane))).at(-1);
  if (key === 'ArrowLeft' || key === 'ArrowRight') {
    const row = in_lane(from.lane);
    const index = row.findIndex((one) => one.spot === from.spot) + (key === 'ArrowLeft' ? -1 : 1);
    return row[Math.max(0, Math.min(row.length - 1, index))] ?? from;
  }
  const step = key === 'ArrowUp' ? -1 : 1;
  const middle = ({ box }: Placed) => box.x + box.width / 2;
  for (let lane = from.lane + step; lane >= 0 && lane < lanes.length; lane += step) {
    const row = in_lane(lane);
    if (row.length > 0)
      return row.reduce((best, one) => (Math.abs(middle(one) - middle(from)) < Math.abs(middle(best) - middle(from)) ? one : best));
  }
  return from;
}
