// Moves things smoothly between received poses. With reduced motion, or over long distances, they jump. Noise of a resting thing is not
// drawn.
import { distance, type FloorPose, turned } from '../../state/floor/floor';

interface Way {
  from: FloorPose;
  to: FloorPose;
  began: number; // ms
  takes: number; // ms
  anchor: FloorPose; // last pose beyond noise from the previous anchor
  moved: number; // ms, time of that
}

const slowest = 300; // ms; with rarer updates, a thing jumps the rest of the way
const quickest = 50;
const leap = 1500; // mm
const settles = 1000; // ms after the last movement, until which every pose is drawn
const least_turn = 6; // degrees

export class Glide {
  is_still = false;
  private ways = new Map<string, Way>();

  /** The drawn pose for a received one. A resting thing keeps its drawn pose until it is more than `slack` mm away. */
  pose(key: string, received: FloorPose, now: number, slack = 0): FloorPose {
    const way = this.ways.get(key);
    if (way === undefined || distance(way.to, received) > leap) {
      this.ways.set(key, { from: received, to: received, began: now, takes: quickest, anchor: received, moved: now });
      return received;
    }
    if (is_off(way.anchor, received, slack)) [way.anchor, way.moved] = [received, now];
    if (!is_off(way.to, received, 0) || now - way.moved >= settles) return between(way, now);
    const takes = Math.min(slowest, Math.max(quickest, now - way.began));
    const next = { ...way, from: this.is_still ? received : between(way, now), to: received, began: now, takes };
    this.ways.set(key, next);
    return between(next, now);
  }

  /** Whether drawing this pose would change the picture. */
  is_news(key: string, received: FloorPose, now: number, slack: number): boolean {
    const way = this.ways.get(key);
    return way === undefined || is_off(way.anchor, received, slack) || (now - way.moved < settles && is_off(way.to, received, 0));
  }

  /** Whether any thing is moving between poses. */
  is_moving(now: number): boolean {
    for (const { began, takes, from, to } of this.ways.values()) if (from !== to && now - began < takes) return true;
    return false;
  }

  /** Removes all other things. */
  keep(keys: ReadonlySet<string>): void {
    for (const key of this.ways.keys()) if (!keys.has(key)) this.ways.delete(key);
  }
}

// Farther than `slack` mm, or turned by more than a few degrees. Without slack, any difference counts.
function is_off(from: FloorPose, to: FloorPose, slack: number): boolean {
  const turn = from.th === undefined || to.th === undefined ? Number(from.th !== to.th) * 360 : Math.abs(turned(to.th - from.th));
  return distance(from, to) > slack || turn > (slack > 0 ? least_turn : 0);
}

function between({ from, to, began, takes }: Way, now: number): FloorPose {
  const share = Math.min(1, Math.max(0, (now - began) / takes));
  if (share === 1) return to;
  const pose: FloorPose = { x: from.x + (to.x - from.x) * share, y: from.y + (to.y - from.y) * share };
  if (to.th !== undefined) pose.th = from.th === undefined ? to.th : from.th + turned(to.th - from.th) * share;
  return pose;
}
