// Robots, persons, faces and sound sources with their last pose and trail.
import type { Located, ReceiveEvent, Results } from 'rois-client';

import { Ring } from '../base/ring';

/** A point of a trail; mm, ms since 1970. */
export interface TrailPoint {
  x: number;
  y: number;
  at: number;
  /** Whether the path from the previous point is unknown. */
  begins?: true;
}

export interface Thing {
  ref: string;
  codebook: string; // of the ref
  component: string; // source
  crs: string;
  x: number; // mm
  y: number;
  z: number;
  th?: number; // degrees counter-clockwise, if known
  covariance?: number[]; // as in `Located`
  at: number; // ms since 1970
  trail: Ring<TrailPoint>;
}

export type Robot = Thing;

export type EntityKind = 'person' | 'face' | 'sound';

export interface Entity extends Thing {
  kind: EntityKind;
  /** Whether the component's last event lists it. */
  is_seen: boolean;
  /** When events of its component began to arrive without results, ms since 1970; undefined while they have results. */
  unknown_since?: number;
  /** The identified person, if known. */
  identity?: { ref: string; codebook: string; at: number };
}

const most_points = 600;
const trail_step = 50; // mm between two points
const gap = { ms: 2000, mm: 700 }; // no report for this time and then a jump of this distance begins a new trail

/** Updates the position of a thing, or creates it. */
export function placed<T extends Thing>(
  known: T | undefined,
  located: Located,
  report: { codebook: string; component: string; at: number },
  make: (thing: Thing) => T,
): T {
  const [x, y, z] = located.position;
  const is_gap = known !== undefined && report.at - known.at > gap.ms && Math.hypot(known.x - x, known.y - y) > gap.mm;
  const thing = known ?? make({ ref: located.ref, crs: located.crs, x, y, z, trail: new Ring(most_points), ...report });
  thing.crs = located.crs;
  thing.component = report.component;
  thing.at = report.at;
  thing.x = x;
  thing.y = y;
  thing.z = z;
  set_or_delete(thing, 'th', located.orientation?.[2]);
  set_or_delete(thing, 'covariance', located.covariance);
  const last = thing.trail.at(-1);
  if (!last || Math.hypot(last.x - x, last.y - y) >= trail_step) thing.trail.push({ x, y, at: report.at, ...(is_gap && { begins: true }) });
  return thing;
}

function set_or_delete<T extends object, Key extends keyof T>(thing: T, key: Key, value: T[Key] | undefined): void {
  if (value === undefined) delete thing[key];
  else thing[key] = value;
}

/** The positions in a result; from texts `x, y, th` if the engine sends no `located` elements. */
export function located_in(results: Results, refs: string, positions = 'position_data'): Located[] {
  const located = results.located.filter((one) => one.of === positions);
  if (located.length > 0) return located;
  const poses = results.poses(positions);
  const crs = results.get(positions)?.data_type_ref.codebook_ref ?? '';
  return results.texts(refs).flatMap((ref, i): Located[] => {
    const pose = poses[i];
    return pose ? [{ of: positions, ref, crs, position: [pose.x, pose.y, 0], orientation: [0, 0, pose.th] }] : [];
  });
}

/** By the event types of the specification. */
export function kind_of_event(event: ReceiveEvent): EntityKind | undefined {
  const kind = /^(person|face|sound)_localized$/.exec(event.event_type)?.[1];
  return kind as EntityKind | undefined;
}

/** One standard deviation as an ellipse: half axes in mm, angle of the first in degrees; undefined if unknown. */
export function ellipse_of({ covariance }: Pick<Thing, 'covariance'>): { a: number; b: number; angle: number } | undefined {
  const side = covariance === undefined ? 0 : Math.sqrt(covariance.length);
  if (covariance === undefined || side < 2 || !Number.isInteger(side)) return undefined;
  const [xx, xy, yy] = [covariance[0]!, covariance[1]!, covariance[side + 1]!];
  const mean = (xx + yy) / 2;
  const spread = Math.hypot((xx - yy) / 2, xy);
  const angle = (Math.atan2(2 * xy, xx - yy) / 2) * (180 / Math.PI);
  return { a: Math.sqrt(Math.max(0, mean + spread)), b: Math.sqrt(Math.max(0, mean - spread)), angle };
}
