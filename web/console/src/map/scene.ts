// The things on the floor now, each with its freshness.
import { distance, frame_named, out_of, turned_by } from '../state/floor/floor';
import type { FloorMap, RobotFrame } from '../state/floor/floor_map';
import { ellipse_of, type Entity, type Robot, type Thing } from '../state/floor/things';
import type { Point } from './view';

export type Kind = 'robot' | Entity['kind'];

/**
 * - `live`: reported just now;
 * - `quiet`: watched but not reported for a while, as a standing person;
 * - `old`: watched but not reported for too long to rely on;
 * - `unknown`: the link is lost, its component has stopped, or events arrive without results;
 * - `gone`: its component reported it out of sight, or a robot has stopped reporting.
 */
export type Freshness = 'live' | 'quiet' | 'old' | 'unknown' | 'gone';

export interface Shown extends Point {
  key: string;
  kind: Kind;
  /** The name; of an identified person the permanent one. */
  name: string;
  thing: Thing;
  th?: number;
  radius: number; // mm
  ellipse?: { a: number; b: number; angle: number };
  freshness: Freshness;
  age: number; // ms since the last report
  identity?: Entity['identity'];
  /** Of a robot: the logical components for which it acts. */
  acts_for?: readonly string[];
  /** The frame of its trail. */
  frame?: RobotFrame;
}

export interface SceneInput {
  robots: Iterable<Robot>;
  entities: Iterable<Entity>;
  map: FloorMap | undefined;
  now: number;
  /** Whether the link is open. */
  is_live: boolean;
  /** Whether a component is working for any session. */
  senses(component: string): boolean;
  /** The logical components for which the unit of a component acts. */
  acts_for(component: string): readonly string[];
}

export interface Scene {
  shown: Shown[];
  /** Things in frames without a known position. */
  lost: Thing[];
}

const robot_radius = 250; // mm, of a robot that is not on the map
const radii: Record<Entity['kind'], number> = { person: 220, face: 90, sound: 110 };
const quiet_after: Record<Kind, number> = { robot: 2000, person: 5000, face: 2000, sound: 1500 }; // ms
const old_after = 30_000; // ms
const shown_for = 30_000; // ms, after it is gone
// Neither the end of a sound nor a face that turns away is reported. A face is shown as long as a person is there.
const echo = 6000; // ms that a sound or face is shown after its last report
const head = 500; // mm
const surely_sensed = 2000; // ms for which a thing counts as watched after its last report, even if no sensor is bound

export function scene_of({ robots, entities, map, now, is_live, senses, acts_for }: SceneInput): Scene {
  const scene: Scene = { shown: [], lost: [] };
  const add = (thing: Thing, kind: Kind, more: Pick<Shown, 'name' | 'radius' | 'freshness' | 'identity' | 'acts_for'>) => {
    const frame = frame_named(map, thing.crs);
    if (frame === 'unknown') return void scene.lost.push(thing);
    const pose = frame ? out_of(frame, thing) : thing;
    const ellipse = ellipse_of(thing);
    const shown: Shown = { key: `${kind} ${thing.ref}`, kind, thing, x: pose.x, y: pose.y, age: Math.max(0, now - thing.at), ...more };
    if (pose.th !== undefined && kind !== 'sound') shown.th = pose.th; // a sound's direction points to it
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
    const is_over =
      age > quiet_after[kind] && (kind === 'sound' || (kind === 'face' && !people.some((one) => distance(one, entity) < head)));
    const freshness = freshness_of(entity, age, is_sensed, is_over);
    if (is_live && (freshness === 'gone' || !is_sensed) && age > (kind === 'person' ? shown_for : echo)) continue;
    add(entity, kind, { name: identity?.ref ?? entity.ref, radius: radii[kind], freshness, identity });
  }
  for (const robot of robots) {
    const radius = map?.robots.find((one) => one.name === robot.ref)?.radius || robot_radius;
    const freshness = is_live && now - robot.at <= quiet_after.robot ? 'live' : 'gone';
    add(robot, 'robot', { name: robot.ref, radius, freshness, acts_for: acts_for(robot.component) });
  }
  return scene;
}

function freshness_of({ kind, is_seen, unknown_since }: Entity, age: number, is_sensed: boolean, is_over: boolean): Freshness {
  if (!is_seen || (is_sensed && is_over)) return 'gone';
  if (!is_sensed || unknown_since !== undefined) return 'unknown';
  if (age > old_after) return 'old';
  return age > quiet_after[kind] ? 'quiet' : 'live';
}
