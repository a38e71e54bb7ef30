// A small map on which a place, a box or a point is picked. What it sets stands in the fields beside it, too; those are for the keyboard.
import { useRef, useState } from 'preact/hooks';

import { useConsole, useWatch } from '../shell/context';
import type { Console } from '../state/console';
import type { Bounds, FloorMap, Place } from '../state/floor_map';
import { is_number } from './checking';
import type { Area } from './model';
import { texts } from './texts';

interface Point {
  x: number;
  y: number;
}

const step = 50; // mm
const margin = 300; // mm
const least_box = 100; // mm: less is a click

export function AreaPicker({ area, change, radius }: { area: Area; change: (area: Area) => void; radius?: number | undefined }) {
  const t = texts();
  const console = useConsole();
  const svg = useRef<SVGSVGElement>(null);
  const [drag, set_drag] = useState<{ from: Point; to: Point } | undefined>();
  const view = console.map.view.value;
  const map = view.state === 'there' ? view.map : undefined;
  const bounds = map?.bounds ?? bounds_around(console);
  const at = (event: PointerEvent): Point => {
    const matrix = svg.current!.getScreenCTM()!.inverse();
    const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix);
    return { x: Math.round(x / step) * step, y: Math.round(-y / step) * step };
  };
  const pressed = (event: PointerEvent) => {
    if (event.button !== 0) return;
    svg.current!.setPointerCapture(event.pointerId);
    set_drag({ from: at(event), to: at(event) });
  };
  const released = (event: PointerEvent) => {
    if (!drag) return;
    set_drag(undefined);
    pick(drag.from, at(event));
  };
  const pick = (from: Point, to: Point) => {
    const place = map?.places.find((one) => Math.abs(to.x - one.x) <= one.width / 2 && Math.abs(to.y - one.y) <= one.depth / 2);
    if (area.kind === 'place') return place && change({ ...area, place: place.name });
    if (area.kind === 'point') return change({ ...area, x: String(to.x), y: String(to.y) });
    if (Math.abs(from.x - to.x) >= least_box && Math.abs(from.y - to.y) >= least_box)
      return change({ ...area, x: String(Math.min(from.x, to.x)), y: String(Math.min(from.y, to.y)), x2: String(Math.max(from.x, to.x)), y2: String(Math.max(from.y, to.y)) });
    // A click on a place takes the place's box.
    if (place) {
      const { x, y, width, depth } = ground_of(place);
      change({ ...area, x: String(x), y: String(y), x2: String(x + width), y2: String(y + depth) });
    }
  };
  const box = drag && area.kind === 'box' ? box_between(drag.from, drag.to) : chosen_box(area, map);
  const point = drag && area.kind === 'point' ? drag.to : chosen_point(area);
  const hint = { box: t.pick_box, point: t.pick_point, place: t.pick_place }[area.kind];
  if (area.kind === 'place' && !map) return null;
  return (
    <figure class="conditions-picker">
      <svg
        ref={svg}
        role="img"
        aria-label={t.picker}
        viewBox={`${bounds.x - margin} ${-bounds.y - bounds.depth - margin} ${bounds.width + 2 * margin} ${bounds.depth + 2 * margin}`}
        onPointerDown={pressed}
        onPointerMove={(event) => drag && set_drag({ ...drag, to: at(event) })}
        onPointerUp={released}
        onPointerCancel={() => set_drag(undefined)}
      >
        <g transform="scale(1 -1)">
          <rect class="conditions-floor" {...rect(bounds)} />
          {map ? <Furnishing map={map} chosen={area.kind === 'place' ? area.place : ''} /> : <Grid bounds={bounds} />}
          <Things />
          {box && <rect class="conditions-chosen" {...rect(box)} />}
          {box && radius && area.kind !== 'point' && <rect class="conditions-reach" x={box.x - radius} y={box.y - radius} width={box.width + 2 * radius} height={box.depth + 2 * radius} rx={radius} />}
          {point && radius && <circle class="conditions-reach" cx={point.x} cy={point.y} r={radius} />}
          {point && <circle class="conditions-chosen" cx={point.x} cy={point.y} r={120} />}
        </g>
        {map?.places.map((one) => (
          <text key={one.name} class="conditions-place-name" x={one.x} y={-one.y}>
            {one.name}
          </text>
        ))}
      </svg>
      <figcaption class="field-hint">{hint}</figcaption>
    </figure>
  );
}

function Furnishing({ map, chosen }: { map: FloorMap; chosen: string }) {
  return (
    <>
      {map.furniture.map((one, i) => <rect key={i} class="conditions-furniture" {...rect(one)} />)}
      {map.places.map((one) => <rect key={one.name} class={one.name === chosen ? 'conditions-place conditions-chosen' : 'conditions-place'} {...rect(ground_of(one))} />)}
      {map.walls.map((one, i) => <line key={i} class="conditions-wall" {...one} />)}
    </>
  );
}

// A line each metre.
function Grid({ bounds: { x, y, width, depth } }: { bounds: Bounds }) {
  const lines = (from: number, length: number) => Array.from({ length: Math.floor(length / 1000) + 1 }, (_, i) => Math.ceil(from / 1000) * 1000 + i * 1000);
  return (
    <>
      {lines(x, width).map((one) => <line key={`x${one}`} class="conditions-grid" x1={one} x2={one} y1={y} y2={y + depth} />)}
      {lines(y, depth).map((one) => <line key={`y${one}`} class="conditions-grid" x1={x} x2={x + width} y1={one} y2={one} />)}
    </>
  );
}

// Where robots and people are now; those in other frames are left out.
function Things() {
  const { robots, entities, map } = useConsole();
  useWatch(robots.poll);
  useWatch(entities);
  void robots.pulse.beat.value;
  void entities.pulse.beat.value;
  const view = map.view.value;
  const is_here = ({ crs }: { crs: string }) => view.state !== 'there' || crs === '' || crs === view.map.crs;
  const people = [...entities.all.values()].filter((one) => one.kind === 'person' && one.is_seen && is_here(one));
  return (
    <>
      {[...robots.all.values()].filter(is_here).map((one) => <circle key={one.ref} class="conditions-robot" cx={one.x} cy={one.y} r={250} />)}
      {people.map((one) => <circle key={one.ref} class="conditions-person" cx={one.x} cy={one.y} r={180} />)}
    </>
  );
}

// The area around a place.
function ground_of({ x, y, width, depth }: Place): Bounds {
  return { x: x - width / 2, y: y - depth / 2, width, depth };
}

function rect({ x, y, width, depth }: Bounds) {
  return { x, y, width, height: depth };
}

function box_between(a: Point, b: Point): Bounds {
  return { x: Math.min(a.x, b.x), y: Math.min(a.y, b.y), width: Math.abs(a.x - b.x), depth: Math.abs(a.y - b.y) };
}

function chosen_box(area: Area, map: FloorMap | undefined): Bounds | undefined {
  if (area.kind === 'place') {
    const place = map?.places.find((one) => one.name === area.place);
    return place && ground_of(place);
  }
  if (area.kind !== 'box' || ![area.x, area.y, area.x2, area.y2].every(is_number)) return undefined;
  return box_between({ x: Number(area.x), y: Number(area.y) }, { x: Number(area.x2), y: Number(area.y2) });
}

function chosen_point({ kind, x, y }: Area): Point | undefined {
  return kind === 'point' && is_number(x) && is_number(y) ? { x: Number(x), y: Number(y) } : undefined;
}

// For engines without a map: 20 m by 14 m, or what holds all that has been seen.
function bounds_around({ robots, entities }: Console): Bounds {
  const seen = [...robots.all.values(), ...entities.all.values()];
  const [xs, ys] = [[0, 20_000, ...seen.map((one) => one.x)], [0, 14_000, ...seen.map((one) => one.y)]] as const;
  const [x, y] = [Math.min(...xs), Math.min(...ys)];
  return { x, y, width: Math.max(...xs) - x, depth: Math.max(...ys) - y };
}
