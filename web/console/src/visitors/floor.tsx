// A small map of the hall on which visitors are dragged to their targets.
import { useSignal } from '@preact/signals';
import { useRef } from 'preact/hooks';

import { useConsole, useWatch } from '../context';
import { bounds_around, distance, type FloorPose, nearest_of, on_map, type Point, turned } from '../state/floor/floor';
import type { FloorMap } from '../state/floor/floor_map';
import type { Visitor } from '../state/floor/hall_state';
import { ellipse_of, type Robot } from '../state/floor/things';
import { floor_point, joined, SmallFloor } from '../ui';
import { steering_of } from './steering';
import * as texts from './texts';

interface Aim extends Point {
  ref: string;
  /** The dragging pointer; undefined: moved by keys. */
  pointer?: number;
  has_moved: boolean;
}

const person_radius = 260; // mm
const slop = 5; // px, tolerance of a click
const steps = { fine: 250, coarse: 1000 }; // mm

export function Floor({ map }: { map: FloorMap | undefined }) {
  const console = useConsole();
  const { hall, robots } = console;
  useWatch(robots.poll);
  const steering = steering_of(console);
  const aim = useSignal<Aim | undefined>(undefined);
  const svg = useRef<SVGSVGElement>(null);
  const drawn = useRef(new Map<string, FloorPose>());
  const pressed_at = useRef<Point>({ x: 0, y: 0 });
  void hall.pulse.beat.value;
  void robots.pulse.beat.value;
  void console.commands.pulse.beat.value;
  const bounds = map?.bounds ?? bounds_around([...hall.visitors.values(), ...robots.all.values()]);

  const send = ({ ref, x, y }: Aim) => void steering.order(ref, 'walk', hall.walk(ref, { x: Math.round(x), y: Math.round(y) }));

  const pressed = (event: PointerEvent, { ref, x, y, steered }: Visitor) => {
    steering.chosen.value = ref;
    if (!steered || event.button !== 0) return;
    (event.currentTarget as Element).setPointerCapture(event.pointerId);
    pressed_at.current = { x: event.clientX, y: event.clientY };
    aim.value = { ref, x, y, pointer: event.pointerId, has_moved: false };
  };
  const moved = (event: PointerEvent) => {
    const now = aim.value;
    if (now?.pointer !== event.pointerId) return;
    if (!now.has_moved && Math.hypot(event.clientX - pressed_at.current.x, event.clientY - pressed_at.current.y) < slop) return;
    aim.value = { ...now, ...nearest_of(bounds, floor_point(svg.current!, event)), has_moved: true };
  };
  const released = (event: PointerEvent) => {
    const now = aim.value;
    if (now?.pointer !== event.pointerId) return;
    aim.value = undefined;
    if (now.has_moved) send(now);
  };
  // A click on the floor sends the selected visitor there.
  const clicked = (event: MouseEvent) => {
    const chosen = hall.visitors.get(steering.chosen.value);
    if (chosen?.steered && !(event.target as Element).closest('[data-visitor]'))
      send({ ref: chosen.ref, has_moved: true, ...nearest_of(bounds, floor_point(svg.current!, event)) });
  };
  const typed = (event: KeyboardEvent, { ref, x, y, steered }: Visitor) => {
    const arrow = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    const now = aim.value?.ref === ref ? aim.value : undefined;
    if (arrow && steered) {
      const step = event.shiftKey ? steps.coarse : steps.fine;
      const from = now ?? { x: Math.round(x / steps.fine) * steps.fine, y: Math.round(y / steps.fine) * steps.fine };
      aim.value = { ref, has_moved: true, ...nearest_of(bounds, { x: from.x + arrow[0]! * step, y: from.y + arrow[1]! * step }) };
    } else if (event.key === 'Enter' || event.key === ' ') {
      steering.chosen.value = ref;
      if (now) send(now);
      aim.value = undefined;
    } else if (event.key === 'Escape' && now) aim.value = undefined;
    else return;
    event.preventDefault();
  };

  const aimed = aim.value;
  return (
    <div class="visitors-floor">
      <SmallFloor svg={svg} bounds={bounds} map={map} onClick={clicked} role="group" aria-label={`${texts.map()} ${texts.map_hint()}`}>
        {[...robots.all.values()].map((robot) => {
          const at = on_map(map, robot.crs, steady(drawn.current, robot));
          const radius = map?.robots.find((one) => one.name === robot.ref)?.radius ?? person_radius;
          return at && <Body key={robot.ref} at={at} radius={radius} kind="robot" name={texts.robot(robot.ref)} />;
        })}
        {[...hall.visitors.values()].map((one) => <Way key={one.ref} visitor={one} map={map} />)}
        {aimed?.has_moved && <Goal from={hall.visitors.get(aimed.ref)} to={aimed} />}
        {[...hall.visitors.values()].map((one) => (
          <g
            key={one.ref}
            class={joined('visitors-person', one.steered && 'visitors-steered', one.ref === steering.chosen.value && 'visitors-chosen')}
            role="button"
            tabindex={0}
            data-visitor={one.ref}
            aria-label={texts.visitor(one.ref, metres(one))}
            aria-pressed={one.ref === steering.chosen.value}
            onPointerDown={(event) => pressed(event, one)}
            onPointerMove={moved}
            onPointerUp={released}
            onPointerCancel={() => (aim.value = undefined)}
            onKeyDown={(event) => typed(event, one)}
            onBlur={() => aim.value?.pointer === undefined && (aim.value = undefined)}
          >
            <circle class="visitors-grip" cx={one.x} cy={-one.y} r={600} />
            <Body at={one} radius={person_radius} kind="person" name="" />
            <text class="visitors-name" x={one.x} y={-one.y - 420}>{one.ref}</text>
          </g>
        ))}
      </SmallFloor>
      <p class="visitors-aim" aria-live="polite">
        {aimed?.has_moved
          ? texts.sends(aimed.ref, metres(aimed))
          : hall.visitors.get(steering.chosen.value)?.steered
            ? texts.click_hint(steering.chosen.value)
            : ''}
      </p>
    </div>
  );

  function metres({ x, y }: Point): string {
    return texts.metres((x / 1000).toFixed(2), (y / 1000).toFixed(2));
  }
}

const noise = 4; // standard deviations of a resting robot's position that are not drawn
const least_turn = 6; // degrees

// The drawn pose, until the robot is farther away than its position's noise.
function steady(drawn: Map<string, FloorPose>, robot: Robot): FloorPose {
  const before = drawn.get(robot.ref);
  const slack = noise * (ellipse_of(robot)?.a ?? 0);
  if (before && distance(before, robot) <= slack && Math.abs(turned((robot.th ?? 0) - (before.th ?? 0))) <= least_turn) return before;
  const { x, y, th } = robot;
  const now = th === undefined ? { x, y } : { x, y, th };
  drawn.set(robot.ref, now);
  return now;
}

// A disc with a nose in the viewing direction.
function Body({ at, radius, kind, name }: { at: FloorPose; radius: number; kind: 'robot' | 'person'; name: string }) {
  const turn = ((at.th ?? 0) * Math.PI) / 180;
  const nose = { x: at.x + Math.cos(turn) * radius * 1.7, y: at.y + Math.sin(turn) * radius * 1.7 };
  return (
    <g class={`visitors-body visitors-is-${kind}`}>
      {name !== '' && <title>{name}</title>}
      {at.th !== undefined && <line x1={at.x} y1={-at.y} x2={nose.x} y2={-nose.y} />}
      <circle cx={at.x} cy={-at.y} r={radius} />
    </g>
  );
}

function Goal({ from, to }: { from: Point | undefined; to: Point }) {
  return (
    <g class="visitors-goal" aria-hidden="true">
      {from && <line x1={from.x} y1={-from.y} x2={to.x} y2={-to.y} />}
      <circle cx={to.x} cy={-to.y} r={person_radius} />
    </g>
  );
}

// The way to a visitor's current target.
function Way({ visitor, map }: { visitor: Visitor; map: FloorMap | undefined }) {
  const { hall } = useConsole();
  const walk = hall.orders_of(visitor.ref).filter((one) => one.command_type === 'walk').at(-1);
  const to = walk && target_of(walk.arguments.find((one) => one.name === 'target_position')?.values[0] ?? '', map);
  return to ? <Goal from={visitor} to={to} /> : null;
}

function target_of(text: string, map: FloorMap | undefined): Point | undefined {
  const [x, y] = text.split(',').map(Number);
  if (x !== undefined && y !== undefined && Number.isFinite(x) && Number.isFinite(y)) return { x, y };
  return map?.places.find((one) => one.name === text);
}
