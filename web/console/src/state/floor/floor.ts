// Geometry of the floor: frames, directions, obstacles.
import type { Bounds, FloorMap, Place, RobotFrame } from './floor_map';

/** mm. */
export interface Point {
  x: number;
  y: number;
}
/** mm, degrees counter-clockwise. */
export interface FloorPose extends Point {
  th?: number;
}

/** Normalizes to -180..180. */
export function turned(degrees: number): number {
  const within = ((degrees % 360) + 360) % 360;
  return within > 180 ? within - 360 : within;
}

export function distance(a: Point, b: Point): number {
  return Math.hypot(a.x - b.x, a.y - b.y);
}

/** The direction from `from` to `to` in degrees. */
export function bearing(from: Point, to: Point): number {
  return (Math.atan2(to.y - from.y, to.x - from.x) * 180) / Math.PI;
}

/** Converts a pose from a robot's frame to the map's. */
export function out_of(frame: RobotFrame, pose: FloorPose): FloorPose {
  const turn = (frame.heading * Math.PI) / 180;
  const placed: FloorPose = {
    x: frame.x + pose.x * Math.cos(turn) - pose.y * Math.sin(turn),
    y: frame.y + pose.x * Math.sin(turn) + pose.y * Math.cos(turn),
  };
  if (pose.th !== undefined) placed.th = turned(pose.th + frame.heading);
  return placed;
}

/**
 * The frame with this name: `undefined` for the map's own frame, `unknown` for one without a known position. Names are
 * case-insensitive.
 */
export function frame_named(map: FloorMap | undefined, crs: string): RobotFrame | undefined | 'unknown' {
  const is = (name: string) => name.toLowerCase() === crs.toLowerCase();
  if (!map || crs === '' || is(map.crs)) return undefined;
  return map.robots.find((one) => one.frame && is(one.frame.crs))?.frame ?? 'unknown';
}

export function on_map(map: FloorMap | undefined, crs: string, pose: FloorPose): FloorPose | undefined {
  const frame = frame_named(map, crs);
  return frame === 'unknown' ? undefined : frame ? out_of(frame, pose) : pose;
}

/** The obstacle at a round robot's position; undefined: none on the map. */
export function obstacle_at(map: FloorMap | undefined, { x, y }: Point, radius: number): 'outside' | 'furniture' | 'wall' | undefined {
  if (!map) return undefined;
  const { bounds } = map;
  if (x - radius < bounds.x || y - radius < bounds.y || x + radius > bounds.x + bounds.width || y + radius > bounds.y + bounds.depth)
    return 'outside';
  if (map.furniture.some((one) => distance({ x, y }, nearest_of(one, { x, y })) < radius)) return 'furniture';
  const near_wall = map.walls.some(({ x1, y1, x2, y2 }) => {
    const length = (x2 - x1) ** 2 + (y2 - y1) ** 2;
    const share = length === 0 ? 0 : Math.min(1, Math.max(0, ((x - x1) * (x2 - x1) + (y - y1) * (y2 - y1)) / length));
    return distance({ x, y }, { x: x1 + share * (x2 - x1), y: y1 + share * (y2 - y1) }) < radius;
  });
  return near_wall ? 'wall' : undefined;
}

/** The nearest point inside a box. */
export function nearest_of(box: Bounds, { x, y }: Point): Point {
  return { x: Math.min(box.x + box.width, Math.max(box.x, x)), y: Math.min(box.y + box.depth, Math.max(box.y, y)) };
}

/** The area of a place, which is given by its centre. */
export function ground_of({ x, y, width, depth }: Place): Bounds {
  return { x: x - width / 2, y: y - depth / 2, width, depth };
}

/** Bounds for engines without a map: 20 m by 14 m, or larger if needed. */
export function bounds_around(seen: readonly Point[]): Bounds {
  const [xs, ys] = [[0, 20_000, ...seen.map((one) => one.x)], [0, 14_000, ...seen.map((one) => one.y)]] as const;
  const [x, y] = [Math.min(...xs), Math.min(...ys)];
  return { x, y, width: Math.max(...xs) - x, depth: Math.max(...ys) - y };
}

/** The angle of a covariance ellipse, converted to the map's frame. */
export function turned_by(frame: RobotFrame | undefined | 'unknown', angle: number): number {
  return frame && frame !== 'unknown' ? turned(angle + frame.heading) : angle;
}
