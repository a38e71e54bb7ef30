// The engine's floor map (`GET /rois/map`): mm, degrees counter-clockwise, x to the right, y up.
import { signal } from '@preact/signals';
import { answer_text, parse_xml, type XmlElement } from 'rois-client';

import type { Environment } from '../base/environment';
import { reason_of } from '../base/reason_of';

export interface Bounds {
  x: number;
  y: number;
  width: number;
  depth: number;
}
export interface Wall {
  x1: number;
  y1: number;
  x2: number;
  y2: number;
}
export interface Place extends Bounds {
  name: string;
  heading: number;
}
/** A robot's own frame: its origin in the map's frame. */
export interface RobotFrame {
  crs: string;
  x: number;
  y: number;
  heading: number;
}
export interface MapRobot {
  name: string;
  radius: number;
  frame?: RobotFrame;
}

export interface FloorMap {
  name: string;
  crs: string;
  bounds: Bounds;
  walls: Wall[];
  furniture: Bounds[];
  places: Place[];
  robots: MapRobot[];
}

/** `none`: the engine has no map; show an empty grid. */
export type MapView = { state: 'unknown' } | { state: 'none' } | { state: 'there'; map: FloorMap } | { state: 'trouble'; reason: string };

export class MapState {
  readonly view = signal<MapView>({ state: 'unknown' });

  constructor(
    private readonly environment: Environment,
    private readonly token: () => string | undefined,
  ) {}

  async load(): Promise<void> {
    const token = this.token();
    const headers: HeadersInit = token === undefined ? {} : { Authorization: `Bearer ${token}` };
    try {
      const answer = await this.environment.fetch('/rois/map', { headers });
      if (answer.status === 404) this.view.value = { state: 'none' };
      else if (!answer.ok) this.view.value = { state: 'trouble', reason: `status ${answer.status}` };
      else this.view.value = { state: 'there', map: read_floor_map(await answer_text(answer)) };
    } catch (error) {
      this.view.value = { state: 'trouble', reason: reason_of(error) };
    }
  }
}

/** Throws XmlError if the text is not XML. Missing numbers are 0. */
export function read_floor_map(text: string): FloorMap {
  const root = parse_xml(text);
  const bounds = root.child('bounds');
  return {
    name: root.attribute('name') ?? '',
    crs: root.attribute('crs') ?? '',
    bounds: bounds ? bounds_of(bounds) : { x: 0, y: 0, width: 0, depth: 0 },
    walls: root.all('wall').map((one) => ({ x1: number(one, 'x1'), y1: number(one, 'y1'), x2: number(one, 'x2'), y2: number(one, 'y2') })),
    furniture: root.all('furniture').map(bounds_of),
    places: root.all('place').map((one) => ({ name: one.attribute('name') ?? '', heading: number(one, 'heading'), ...bounds_of(one) })),
    robots: root.all('robot').map(robot_of),
  };
}

function number(from: XmlElement, name: string): number {
  const read = Number(from.attribute(name) ?? 0);
  return Number.isFinite(read) ? read : 0;
}

function bounds_of(from: XmlElement): Bounds {
  return { x: number(from, 'x'), y: number(from, 'y'), width: number(from, 'width'), depth: number(from, 'depth') };
}

function robot_of(from: XmlElement): MapRobot {
  const frame = from.child('frame');
  const robot: MapRobot = { name: from.attribute('name') ?? '', radius: number(from, 'radius') };
  if (frame)
    robot.frame = { crs: frame.attribute('crs') ?? '', x: number(frame, 'x'), y: number(frame, 'y'), heading: number(frame, 'heading') };
  return robot;
}
