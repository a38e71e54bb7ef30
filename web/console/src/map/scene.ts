// What is on the floor now: robots, people, faces and sounds, each with how sure one can be that it is still there.
import type { FloorMap, RobotFrame } from '../state/floor_map';
import { ellipse_of, type Entity, type Robot, type Thing } from '../state/things';
import { distance, frame_named, out_of, turned_by } from '../state/floor';
import type { Point } from './view';

export type Kind = 'robot' | Entity['kind'];

/**
 * - `live`: told of just now;
 * - `quiet`: sensed, but not told of for a while: who stands still is not told of;
 * - `old`: sensed, and not told of for so long that one should not rely on it;
 * - `unknown`: the link is lost, nobody senses any longer, or the events come without results: nobody knows whether it is still there;
 * - `gone`: its component has told that it is out of sight, or a robot tells nothing. It was there.
 */
export type Freshness = 'live' | 'quiet' | 'old' | 'unknown' | 'gone';

export interface Shown extends Point {
  key: string;
  kind: Kind;
  /** Its name: the permanent one of somebody who was identified. */
  name: string;
  thing: Thing;
  th?: number;
  radius: number; // mm
  ellipse?: { a: number; b: number; angle: number };
  freshness: Freshness;
  age: number; // ms since it was told of
  identity?: Entity['identity'];
  /** Of its trail's points. */
  frame?: RobotFrame;
}

export interface Told {
  robots: Iterable<Robot>;
  entities: Iterable<Entity>;
  map: FloorMap | undefined;
  now: number;
  /** Whether the link is open. */
  is_live: boolean;
  /** Whether anybody has this component sense. */
  senses(component: string): boolean;
}

export interface Scene {
  shown: Shown[];
  /** Told in a frame of which nobody knows where it is. */
  lost: Thing[];
}

const robot_radius = 250; // mm, of one that is not on the map
const radii: Record<Entity['kind'], number> = { person: 220, face: 90, sound: 110 };
const quiet_after: Record<Kind, number> = { robot: 2000, person: 5000, face: 2000, sound: 1500 }; // ms
const old_after = 30_000; // ms
const shown_for = 30_000; // ms, when it is gone
// Nobody tells that a sound is over, or that somebody has looked away: a sound that is not told of any more is over, and a face is where
// it was as long as somebody is there.
const echo = 6000; // ms for which they are shown then
const head = 500; // mm
const surely_sensed = 2000; // ms: who was told of just now is sensed, whatever one knows of bindings

export function scene_of({ robots, entities, map, now, is_live, senses }: Told): Scene {
  const scene: Scene = { shown: [], lost: [] };
  const add = (thing: Thing, kind: Kind, more: Pick<Shown, 'name' | 'radius' | 'freshness' | 'identity'>) => {
    const frame = frame_named(map, thing.crs);
    if (frame === 'unknown') return void scene.lost.push(thing);
    const pose = frame ? out_of(frame, thing) : thing;
    const ellipse = ellipse_of(thing);
    const shown: Shown = { key: `${kind} ${thing.ref}`, kind, thing, x: pose.x, y: pose.y, age: Math.max(0, now - thing.at), ...more };
    if (pose.th !== undefined && kind !== 'sound') shown.th = pose.th; // a sound's is where it is heard, not where it looks
    if (ellipse) shown.ellipse = { ...ellipse, angle: turned_by(frame, ellipse.angle) };
    if (frame) shown.frame = frame;
    scene.shown.push(shown);
  };
  const all = [...entities];
  const people = all.filter((one) => one.kind === 'person' && one.is_seen);
  for (const entity of all) {
    const { kind, identity } = entity;
    const age = now - entity.at;
    const is_sensed = is_live && (age < surely_sensed || senses(entity.component));
    const is_over = age > quiet_after[kind] && (kind === 'sound' || (kind === 'face' && !people.some((one) => distance(one, entity) < head)));
    const freshness: Freshness = !entity.is_seen || (is_sensed && is_over) ? 'gone' : !is_sensed || entity.unknown_since !== undefined ? 'unknown' : age > old_after ? 'old' : age > quiet_after[kind] ? 'quiet' : 'live';
    if (is_live && (freshness === 'gone' || !is_sensed) && age > (kind === 'person' ? shown_for : echo)) continue;
    add(entity, kind, { name: identity?.ref ?? entity.ref, radius: radii[kind], freshness, identity });
  }
  for (const robot of robots) {
    const radius = map?.robots.find((one) => one.name === robot.ref)?.radius || robot_radius;
    add(robot, 'robot', { name: robot.ref, radius, freshness: is_live && now - robot.at <= quiet_after.robot ? 'live' : 'gone' });
  }
  return scene;
}
