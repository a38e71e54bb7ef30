// The ways that things have come, on a canvas of their own: while the view stays, only what is new is drawn.
import { out_of } from '../state/floor';
import { color_of } from './glyphs';
import type { Pen } from './pen';
import type { Shown } from './scene';
import type { TrailPoint } from '../state/things';
import type { Point } from './view';

const longest = { robot: 600, person: 200, face: 0, sound: 0 }; // points
const overhang = 60; // points that may stay too long before all is drawn anew
const lag = 300; // ms: what is drawn glides behind what was told

interface Drawn {
  ring: Shown['thing']['trail'];
  from: number; // numbers of points
  to: number; // the next to be drawn
  last: Point | undefined; // on the floor
}

export class Trails {
  private drawn = new Map<string, Drawn>();

  /** The view, or anything else, is another one. */
  forget(): void {
    this.drawn.clear();
  }

  /** Whether something on it has to vanish. */
  is_stale(shown: readonly Shown[]): boolean {
    if (this.drawn.size === 0) return false;
    const those = new Map(shown.map((one) => [one.key, one]));
    for (const [key, { ring, from }] of this.drawn) {
      const one = those.get(key);
      if (!one || one.thing.trail !== ring || oldest(one) - from > overhang) return true;
    }
    return false;
  }

  /** Draws what is not there yet. */
  draw(pen: Pen, shown: readonly Shown[], now: number): void {
    pen.context.lineJoin = 'round';
    pen.context.lineCap = 'round';
    for (const one of shown) {
      if (longest[one.kind] === 0) continue;
      const ring = one.thing.trail;
      const state = this.drawn.get(one.key) ?? { ring, from: oldest(one), to: oldest(one), last: undefined };
      this.drawn.set(one.key, state);
      const end = ring.first + ring.size;
      let is_begun = false;
      for (; state.to < end; ++state.to) {
        const point = ring.numbered(state.to);
        if (!point || point.at > now - lag) break;
        const at = on_floor(one, point);
        if (!is_begun) pen.context.beginPath();
        const to = pen.at(at);
        if (point.begins) pen.context.moveTo(to.x, to.y);
        else if (!is_begun && state.last) move(pen, state.last);
        is_begun = true;
        pen.context.lineTo(to.x, to.y);
        state.last = at;
      }
      if (is_begun) pen.stroke(color_of(one.kind, pen.palette), one.kind === 'robot' ? 2.5 : 1.8);
    }
  }

  /** Where the trail ends that is drawn; the rest of the way is to where the thing is drawn. */
  end_of(key: string): Point | undefined {
    return this.drawn.get(key)?.last;
  }
}

function move(pen: Pen, to: Point): void {
  const at = pen.at(to);
  pen.context.moveTo(at.x, at.y);
}

function oldest({ kind, thing: { trail } }: Shown): number {
  return Math.max(trail.first, trail.first + trail.size - longest[kind]);
}

function on_floor({ frame }: Shown, point: TrailPoint): Point {
  return frame ? out_of(frame, point) : point;
}
