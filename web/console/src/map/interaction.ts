// Map input by pointer, wheel and keys, as pure functions from state to state.
import { turned } from '../state/floor/floor';
import { panned, pinched, type Point, type Size, to_floor, to_screen, type View, with_point, zoomed } from './view';

/** Target for a robot. Without `th`, the robot keeps its direction of arrival. */
export interface Target extends Point {
  th?: number;
  /** The place whose name is sent, until the user changes the direction. */
  place?: string;
  /** Name of the person or thing there. */
  whom?: string;
}

/** The thing under a point of the screen. */
export type Hit =
  | { what: 'floor' }
  | { what: 'target' }
  | { what: 'thing'; key: string }
  | { what: 'place'; name: string; x: number; y: number; th: number };

type Gesture =
  | { kind: 'none' }
  | { kind: 'pressed'; pointer: number; at: Point; hit: Hit }
  | { kind: 'panning'; pointer: number; at: Point }
  | { kind: 'turning'; pointer: number }
  | { kind: 'pinching'; pointers: [number, number]; at: [Point, Point] };

export interface Interaction {
  /** Undefined: the whole floor, whatever the screen's size. */
  view: View | undefined;
  target: Target | undefined;
  /** Key of the selected thing. */
  chosen: string | undefined;
  /** The keyboard's cursor on the floor. */
  cursor: Point | undefined;
  gesture: Gesture;
}

export const at_rest: Interaction = { view: undefined, target: undefined, chosen: undefined, cursor: undefined, gesture: { kind: 'none' } };

/** The surroundings of an input. */
export interface Surroundings {
  size: Size;
  /** The view while `view` is undefined. */
  whole: View;
  hit(at: Point): Hit;
  /** The direction in which the robot would arrive there. */
  arrival(at: Point): number;
  /** The things that N and P step through. */
  things: readonly ({ key: string } & Point)[];
}

export type Input =
  | { kind: 'press'; pointer: number; at: Point; aims: boolean }
  | { kind: 'move'; pointer: number; at: Point }
  | { kind: 'release'; pointer: number; at: Point }
  | { kind: 'cancel'; pointer: number }
  | { kind: 'wheel'; at: Point; factor: number }
  | { kind: 'zoom'; factor: number }
  | { kind: 'fit' }
  | { kind: 'target'; target: Target | undefined }
  | { kind: 'choose'; key: string | undefined }
  | { kind: 'key'; key: string; shift: boolean; ctrl: boolean };

const slop = 5; // px, tolerance of a click
const edge = 48; // px, distance of the cursor from the edge
const steps = { fine: 250, coarse: 1000 }; // mm
const turn_step = 15; // degrees
export const key_zoom = 1.25;

/** Returns the same object if nothing has changed. */
export function stepped(before: Interaction, input: Input, around: Surroundings): Interaction {
  const view = before.view ?? around.whole;
  const middle = { x: around.size.width / 2, y: around.size.height / 2 };
  switch (input.kind) {
    case 'press':
      return pressed(before, input, around);
    case 'move':
      return moved(before, input, around);
    case 'release':
      return released(before, input.pointer, around);
    case 'cancel':
      return involves(before.gesture, input.pointer) ? { ...before, gesture: { kind: 'none' } } : before;
    case 'wheel':
      return { ...before, view: zoomed(view, around.size, input.at, input.factor) };
    case 'zoom':
      return {
        ...before,
        view: zoomed(view, around.size, before.cursor ? to_screen(view, around.size, before.cursor) : middle, input.factor),
      };
    case 'fit':
      return { ...before, view: undefined };
    case 'target':
      return { ...before, target: input.target, chosen: undefined };
    case 'choose':
      return { ...before, chosen: input.key, target: undefined };
    case 'key':
      return typed(before, input, around);
  }
}

function involves(gesture: Gesture, pointer: number): boolean {
  if (gesture.kind === 'none') return false;
  return gesture.kind === 'pinching' ? gesture.pointers.includes(pointer) : gesture.pointer === pointer;
}

function pressed(before: Interaction, { pointer, at, aims }: Input & { kind: 'press' }, around: Surroundings): Interaction {
  const { gesture } = before;
  if (gesture.kind === 'pressed' || gesture.kind === 'panning')
    return { ...before, gesture: { kind: 'pinching', pointers: [gesture.pointer, pointer], at: [gesture.at, at] } };
  if (gesture.kind !== 'none') return before;
  const without_cursor = { ...before, cursor: undefined };
  if (aims)
    return {
      ...without_cursor,
      target: rounded(to_floor(before.view ?? around.whole, around.size, at)),
      chosen: undefined,
      gesture: { kind: 'turning', pointer },
    };
  return { ...without_cursor, gesture: { kind: 'pressed', pointer, at, hit: around.hit(at) } };
}

function moved(before: Interaction, { pointer, at }: Input & { kind: 'move' }, around: Surroundings): Interaction {
  const { gesture } = before;
  if (!involves(gesture, pointer)) return before;
  const view = before.view ?? around.whole;
  switch (gesture.kind) {
    case 'pressed':
      if (Math.hypot(at.x - gesture.at.x, at.y - gesture.at.y) < slop) return before;
      if (gesture.hit.what === 'target') return turned_to(before, pointer, at, around);
      return { ...before, view: panned(view, at.x - gesture.at.x, at.y - gesture.at.y), gesture: { kind: 'panning', pointer, at } };
    case 'panning':
      return { ...before, view: panned(view, at.x - gesture.at.x, at.y - gesture.at.y), gesture: { ...gesture, at } };
    case 'turning':
      return turned_to(before, pointer, at, around);
    case 'pinching': {
      const after: [Point, Point] = gesture.pointers[0] === pointer ? [at, gesture.at[1]] : [gesture.at[0], at];
      return { ...before, view: pinched(view, around.size, gesture.at, after), gesture: { ...gesture, at: after } };
    }
    default:
      return before;
  }
}

// Turns the target towards the pointer. Too near, there is no direction.
function turned_to(before: Interaction, pointer: number, at: Point, around: Surroundings): Interaction {
  const { target } = before;
  if (!target) return before;
  const from = to_screen(before.view ?? around.whole, around.size, target);
  const gesture: Gesture = { kind: 'turning', pointer };
  if (Math.hypot(at.x - from.x, at.y - from.y) < 2 * slop) return { ...before, gesture };
  const th = (Math.atan2(from.y - at.y, at.x - from.x) * 180) / Math.PI;
  return { ...before, target: with_direction(target, th), gesture };
}

function released(before: Interaction, pointer: number, around: Surroundings): Interaction {
  const { gesture } = before;
  if (!involves(gesture, pointer)) return before;
  const after: Interaction = { ...before, gesture: { kind: 'none' } };
  if (gesture.kind === 'pressed') return clicked(after, gesture.hit, to_floor(before.view ?? around.whole, around.size, gesture.at));
  if (gesture.kind !== 'pinching') return after;
  const stays = gesture.pointers[0] === pointer ? 1 : 0;
  return { ...after, gesture: { kind: 'panning', pointer: gesture.pointers[stays], at: gesture.at[stays] } };
}

function clicked(before: Interaction, hit: Hit, at: Point): Interaction {
  switch (hit.what) {
    case 'target':
      return before;
    case 'thing':
      return { ...before, chosen: hit.key, target: undefined };
    case 'place':
      return { ...before, chosen: undefined, target: { x: hit.x, y: hit.y, th: hit.th, place: hit.name } };
    case 'floor':
      return { ...before, chosen: undefined, target: rounded(at) };
  }
}

function typed(before: Interaction, { key, shift, ctrl }: Input & { kind: 'key' }, around: Surroundings): Interaction {
  const view = before.view ?? around.whole;
  const arrow = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[key];
  if (arrow && ctrl) return { ...before, view: panned(view, -80 * arrow[0]!, 80 * arrow[1]!) };
  if (arrow) {
    const step = shift ? steps.coarse : steps.fine;
    const from = before.cursor ?? before.target ?? { x: view.x, y: view.y };
    return to_cursor(
      before,
      { x: (Math.round(from.x / step) + arrow[0]!) * step, y: (Math.round(from.y / step) + arrow[1]!) * step },
      around,
    );
  }
  if (ctrl) return before;
  switch (key) {
    case '+':
    case '=':
      return stepped(before, { kind: 'zoom', factor: key_zoom }, around);
    case '-':
      return stepped(before, { kind: 'zoom', factor: 1 / key_zoom }, around);
    case '0':
    case 'Home':
      return stepped(before, { kind: 'fit' }, around);
    case 'Enter':
    case ' ': {
      const cursor = before.cursor ?? { x: view.x, y: view.y };
      return clicked({ ...before, cursor }, around.hit(to_screen(view, around.size, cursor)), cursor);
    }
    case 'q':
    case 'e': {
      const { target } = before;
      if (!target) return before;
      return { ...before, target: with_direction(target, (target.th ?? around.arrival(target)) + (key === 'q' ? turn_step : -turn_step)) };
    }
    case 'n':
      return to_thing(before, 1, around);
    case 'p':
      return to_thing(before, -1, around);
    case 'Escape':
      return escaped(before);
    default:
      return before;
  }
}

/** Keys of the map; all others are the page's. */
export function is_map_key({ key, ctrlKey, metaKey, altKey }: Pick<KeyboardEvent, 'key' | 'ctrlKey' | 'metaKey' | 'altKey'>): boolean {
  if (altKey || metaKey) return false;
  return /^(Arrow.*|Enter)$/.test(key) || (!ctrlKey && /^([-+=0qenp ]|Home|Escape)$/.test(key));
}

function to_thing(before: Interaction, step: number, around: Surroundings): Interaction {
  const { things } = around;
  if (things.length === 0) return before;
  const at = things.findIndex((one) => one.key === before.chosen);
  const thing = things[at < 0 ? (step > 0 ? 0 : things.length - 1) : (at + step + things.length) % things.length]!;
  return { ...to_cursor(before, { x: thing.x, y: thing.y }, around), chosen: thing.key, target: undefined };
}

function to_cursor(before: Interaction, cursor: Point, around: Surroundings): Interaction {
  const view = before.view ?? around.whole;
  const seen = with_point(view, around.size, cursor, edge);
  const stays = seen.x === view.x && seen.y === view.y;
  return { ...before, cursor, view: stays ? before.view : seen };
}

// Drops one thing at a time.
function escaped(before: Interaction): Interaction {
  if (before.gesture.kind !== 'none') return { ...before, gesture: { kind: 'none' } };
  if (before.target) return { ...before, target: undefined };
  if (before.chosen !== undefined) return { ...before, chosen: undefined };
  return before.cursor ? { ...before, cursor: undefined } : before;
}

// In whole degrees. Drops the place: its own direction no longer applies.
function with_direction({ x, y, whom }: Target, th: number): Target {
  return { x, y, th: Math.round(turned(th)), ...(whom !== undefined && { whom }) };
}

// Rounded to the displayed precision.
function rounded({ x, y }: Point): Target {
  return { x: Math.round(x / 10) * 10, y: Math.round(y / 10) * 10 };
}
