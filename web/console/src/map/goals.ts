// Current goals of robots, sent by any session.
import { useEffect } from 'preact/hooks';
import { pose_of, type Parameter } from 'rois-client';

import { useConsole } from '../context';
import type { Console } from '../state/console';
import { distance, on_map } from '../state/floor/floor';
import type { FloorMap } from '../state/floor/floor_map';
import type { Thing } from '../state/floor/things';
import { type Driver, drivers_of, motions_of, whither_of } from './driving';
import { position } from './formats';
import type { Shown } from './scene';
import type { Point } from './view';

export interface Goal extends Point {
  driver: Driver;
  /** The robot on its way; of a logical component, the one that acts. Undefined if unknown. */
  robot: Thing | undefined;
  kind: 'go' | 'follow';
  th?: number;
  text: string; // name of the place or followed person, or the position
  /** Sent by this console. For other sessions, only the last set parameters are known. */
  is_mine: boolean;
}

type Place = Omit<Goal, 'driver' | 'robot' | 'is_mine'>;

const arrived = 300; // mm

/** The known goals of all moving robots. */
export function goals_of(console: Console, shown: readonly Shown[]): Goal[] {
  return drivers_of(console).flatMap((driver) => goal_of(console, driver, shown) ?? []);
}

function goal_of(console: Console, driver: Driver, shown: readonly Shown[]): Goal | undefined {
  const motion = motions_of(console, driver).at(-1);
  const view = console.map.view.value;
  for (const ref of motion ? [motion.component] : components_of(console, driver)) {
    const given = (name: string) =>
      motion?.arguments.find((one) => one.name.toLowerCase() === name) ?? console.parameters.of(ref)?.get(name);
    const goal =
      ref === driver.follow
        ? followed(given('target_object_ref'), shown)
        : place_of(given('target_position'), view.state === 'there' ? view.map : undefined);
    if (!goal) continue;
    const robot = driver.robot ?? shown.find(({ acts_for }) => acts_for?.includes(ref))?.thing;
    const is_there = robot !== undefined && distance(robot, goal) < arrived;
    if (motion || !is_there) return { ...goal, text: whither_of(motion) ?? goal.text, driver, robot, is_mine: motion !== undefined };
  }
  return undefined;
}

/** Components whose parameters give the robot's goal: bound by other sessions, or working for this console. */
function components_of(console: Console, driver: Driver): string[] {
  const at_work = motions_of(console, driver).map((one) => one.component);
  return [driver.navigation, driver.follow]
    .filter((ref) => ref !== undefined)
    .filter((ref) => at_work.includes(ref) || console.status.of(ref)?.status === 'BUSY');
}

/** Polls their parameters. */
export function useGoals(): void {
  const console = useConsole();
  void console.commands.pulse.beat.value;
  const refs = drivers_of(console).flatMap((driver) => components_of(console, driver));
  useEffect(() => {
    const stops = refs.map((ref) => console.parameters.poll(ref).watch());
    return () => stops.forEach((stop) => stop());
  }, [refs.join(' ')]);
}

// The last position is the goal.
function place_of(target: Parameter | undefined, map: FloorMap | undefined): Place | undefined {
  const text = target?.values.at(-1)?.trim();
  if (text === undefined) return undefined;
  const place = map?.places.find((one) => one.name.toLowerCase() === text.toLowerCase());
  if (place) return { kind: 'go', x: place.x, y: place.y, th: place.heading, text: place.name };
  const pose = pose_of(text);
  const has_direction = text.split(',').length > 2;
  const placed = pose && on_map(map, target?.data_type_ref.codebook_ref ?? '', has_direction ? pose : { x: pose.x, y: pose.y });
  return placed && { kind: 'go', ...placed, text: position(placed) };
}

function followed(target: Parameter | undefined, shown: readonly Shown[]): Place | undefined {
  const ref = target?.values[0];
  const object = shown.find(
    (one) => (one.kind === 'person' || one.kind === 'robot') && (one.identity?.ref === ref || one.thing.ref === ref),
  );
  return object && { kind: 'follow', x: object.x, y: object.y, text: object.name };
}
