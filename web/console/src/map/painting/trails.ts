// Trails on a separate canvas: while the view stays, only new parts are drawn.
import { out_of } from '../../state/floor/floor';
import type { TrailPoint } from '../../state/floor/things';
import type { Shown } from '../scene';
import type { Point } from '../view';
import { color_of } from './glyphs';
import type { Pen } from './pen';

const longest = { robot: 600, person: 200, face: 0, sound: 0 }; // points
const overhang = 60; // points over the limit at which the whole trail is redrawn
const lag = 300; // ms: the drawing lags behind the reports

interface Drawn {
  ring: Shown['thing']['trail'];
  from: number; // numbers of points
  to: number; // the next to draw
  last: Point | undefined; // on the floor
}

export class Trails {
  private drawn = new Map<string, Drawn>();

  /** Forgets all drawn trails, as after a change of view. */
  forget(): void {
    this.drawn.clear();
  }

  /** Whether a drawn part must be removed. */
  is_stale(shown: readonly Shown[]): boolean {
    if (this.drawn.size === 0) return false;
    const by_key = new Map(shown.map((one) => [one.key, one]));
    for (const [key, { ring, from }] of this.drawn) {
      const one = by_key.get(key);
      if (!one || one.thing.trail !== ring || oldest(one) - from > overhang) return true;
    }
    return false;
  }

  /** Draws the new parts. */
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

  /** The end of the drawn trail. The rest leads to the thing's drawn pose. */
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
