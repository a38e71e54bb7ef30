// Between two places that were told, things move evenly. With reduced motion, or after a leap, they jump.
import { distance, type FloorPose, turned } from '../state/floor';

interface Way {
  from: FloorPose;
  to: FloorPose;
  began: number; // ms
  takes: number; // ms
}

const slowest = 300; // ms; who is told of less often jumps the rest of the way
const quickest = 50;
const leap = 1500; // mm

export class Glide {
  is_still = false;
  private ways = new Map<string, Way>();

  /** Where a thing is drawn that was told to be there. */
  pose(key: string, told: FloorPose, now: number): FloorPose {
    const way = this.ways.get(key);
    if (way === undefined || this.is_still || distance(way.to, told) > leap) {
      this.ways.set(key, { from: told, to: told, began: now, takes: quickest });
      return told;
    }
    if (way.to.x !== told.x || way.to.y !== told.y || way.to.th !== told.th) {
      const takes = Math.min(slowest, Math.max(quickest, now - way.began));
      this.ways.set(key, { from: between(way, now), to: told, began: now, takes });
    }
    return between(this.ways.get(key)!, now);
  }

  /** Whether something has not arrived. */
  is_moving(now: number): boolean {
    for (const { began, takes, from, to } of this.ways.values()) if (from !== to && now - began < takes) return true;
    return false;
  }

  /** Forgets all but these. */
  keep(keys: ReadonlySet<string>): void {
    for (const key of this.ways.keys()) if (!keys.has(key)) this.ways.delete(key);
  }
}

function between({ from, to, began, takes }: Way, now: number): FloorPose {
  const share = Math.min(1, Math.max(0, (now - began) / takes));
  if (share === 1) return to;
  const pose: FloorPose = { x: from.x + (to.x - from.x) * share, y: from.y + (to.y - from.y) * share };
  if (to.th !== undefined) pose.th = from.th === undefined ? to.th : from.th + turned(to.th - from.th) * share;
  return pose;
}
