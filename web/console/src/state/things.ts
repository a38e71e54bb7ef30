// Where things are: robots, people, faces and sound sources, each with its last pose and the way that it came.
import type { Located, ReceiveEvent, Results } from 'rois-client';

import { Ring } from './ring';

/** A point of a trail; mm, ms since 1970. */
export interface TrailPoint {
  x: number;
  y: number;
  at: number;
  /** Nobody knows the way from the point before it. */
  begins?: true;
}

export interface Thing {
  ref: string;
  codebook: string; // of the ref
  component: string; // who told it
  crs: string;
  x: number; // mm
  y: number;
  z: number;
  th?: number; // degrees counter-clockwise, when it has a direction
  covariance?: number[]; // as in `Located`
  reliability?: number; // 0 to 1
  at: number; // when it was told, ms since 1970
  trail: Ring<TrailPoint>;
}

export type Robot = Thing;

export type EntityKind = 'person' | 'face' | 'sound';

export interface Entity extends Thing {
  kind: EntityKind;
  /** Whether it was in what its component told last. */
  is_seen: boolean;
  /** When its component told last without saying whom it sees: unknown since then. Absent while results come. */
  unknown_since?: number;
  /** Who it is, when identification has said so. */
  identity?: { ref: string; codebook: string; at: number };
}

const most_points = 600;
const trail_step = 50; // mm between two points
const gap = { ms: 2000, mm: 700 }; // nothing was told for so long, and then from so far away

/** Sets where a thing is, and makes it when it is new. */
export function placed<T extends Thing>(known: T | undefined, located: Located, told: { codebook: string; component: string; at: number }, make: (thing: Thing) => T): T {
  const [x, y, z] = located.position;
  const is_gap = known !== undefined && told.at - known.at > gap.ms && Math.hypot(known.x - x, known.y - y) > gap.mm;
  const thing = known ?? make({ ref: located.ref, crs: located.crs, x, y, z, trail: new Ring(most_points), ...told });
  thing.crs = located.crs;
  thing.component = told.component;
  thing.at = told.at;
  thing.x = x;
  thing.y = y;
  thing.z = z;
  set_or_delete(thing, 'th', located.orientation?.[2]);
  set_or_delete(thing, 'covariance', located.covariance);
  set_or_delete(thing, 'reliability', located.reliability);
  const last = thing.trail.at(-1);
  if (!last || Math.hypot(last.x - x, last.y - y) >= trail_step) thing.trail.push({ x, y, at: told.at, ...(is_gap && { begins: true }) });
  return thing;
}

function set_or_delete<T extends object, Key extends keyof T>(thing: T, key: Key, value: T[Key] | undefined): void {
  if (value === undefined) delete thing[key];
  else thing[key] = value;
}

/** What is located in a result; from the texts `x, y, th` when the engine tells no `located` elements. */
export function located_in(results: Results, refs: string, positions = 'position_data'): Located[] {
  const told = results.located.filter((one) => one.of === positions);
  if (told.length > 0) return told;
  const poses = results.poses(positions);
  const crs = results.get(positions)?.data_type_ref.codebook_ref ?? '';
  return results.texts(refs).flatMap((ref, i): Located[] => {
    const pose = poses[i];
    return pose ? [{ of: positions, ref, crs, position: [pose.x, pose.y, 0], orientation: [0, 0, pose.th] }] : [];
  });
}

/** By the names of the specification's events. */
export function kind_told_by(event: ReceiveEvent): EntityKind | undefined {
  const kind = /^(person|face|sound)_localized$/.exec(event.event_type)?.[1];
  return kind as EntityKind | undefined;
}

/** Half axes in mm and the angle of the first one in degrees, for one standard deviation; undefined when nothing is known. */
export function ellipse_of({ covariance }: Pick<Thing, 'covariance'>): { a: number; b: number; angle: number } | undefined {
  const side = covariance === undefined ? 0 : Math.sqrt(covariance.length);
  if (covariance === undefined || side < 2 || !Number.isInteger(side)) return undefined;
  const [xx, xy, yy] = [covariance[0]!, covariance[1]!, covariance[side + 1]!];
  const mean = (xx + yy) / 2;
  const spread = Math.hypot((xx - yy) / 2, xy);
  const angle = (Math.atan2(2 * xy, xx - yy) / 2) * (180 / Math.PI);
  return { a: Math.sqrt(Math.max(0, mean + spread)), b: Math.sqrt(Math.max(0, mean - spread)), angle };
}
