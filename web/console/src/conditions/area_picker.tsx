// A small map to pick a place, box or point. The fields beside it show the same values and serve the keyboard.
import { useRef, useState } from 'preact/hooks';

import { useConsole, useWatch } from '../context';
import { bounds_around, ground_of, type Point } from '../state/floor/floor';
import type { Bounds, FloorMap } from '../state/floor/floor_map';
import { floor_point, rect, SmallFloor } from '../ui';
import { is_number } from './checking';
import type { Area } from './model';
import * as texts from './texts';

const step = 50; // mm
const least_box = 100; // mm; less is a click

export function AreaPicker({ area, change, radius }: { area: Area; change: (area: Area) => void; radius?: number | undefined }) {
  const console = useConsole();
  const svg = useRef<SVGSVGElement>(null);
  const [drag, set_drag] = useState<{ from: Point; to: Point } | undefined>();
  const view = console.map.view.value;
  const map = view.state === 'there' ? view.map : undefined;
  const bounds = map?.bounds ?? bounds_around([...console.robots.all.values(), ...console.entities.all.values()]);
  const at = (event: PointerEvent): Point => {
    const { x, y } = floor_point(svg.current!, event);
    return { x: Math.round(x / step) * step, y: Math.round(y / step) * step };
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
      return change({
        ...area,
        x: String(Math.min(from.x, to.x)),
        y: String(Math.min(from.y, to.y)),
        x2: String(Math.max(from.x, to.x)),
        y2: String(Math.max(from.y, to.y)),
      });
    // A click on a place selects the place's box.
    if (place) {
      const { x, y, width, depth } = ground_of(place);
      change({ ...area, x: String(x), y: String(y), x2: String(x + width), y2: String(y + depth) });
    }
  };
  const box = drag && area.kind === 'box' ? box_between(drag.from, drag.to) : chosen_box(area, map);
  const point = drag && area.kind === 'point' ? drag.to : chosen_point(area);
  const hint = { box: texts.pick_box(), point: texts.pick_point(), place: texts.pick_place() }[area.kind];
  if (area.kind === 'place' && !map) return null;
  return (
    <figure class="conditions-picker">
      <SmallFloor
        svg={svg}
        bounds={bounds}
        map={map}
        role="img"
        aria-label={texts.picker()}
        onPointerDown={pressed}
        onPointerMove={(event) => drag && set_drag({ ...drag, to: at(event) })}
        onPointerUp={released}
        onPointerCancel={() => set_drag(undefined)}
      >
        <g transform="scale(1 -1)">
          <Things />
          {box && <rect class="conditions-chosen" {...rect(box)} />}
          {box && radius && area.kind !== 'point' && (
            <rect
              class="conditions-reach"
              x={box.x - radius}
              y={box.y - radius}
              width={box.width + 2 * radius}
              height={box.depth + 2 * radius}
              rx={radius}
            />
          )}
          {point && radius && <circle class="conditions-reach" cx={point.x} cy={point.y} r={radius} />}
          {point && <circle class="conditions-chosen" cx={point.x} cy={point.y} r={120} />}
        </g>
      </SmallFloor>
      <figcaption class="field-hint">{hint}</figcaption>
    </figure>
  );
}

// The present robots and persons in the map's frame.
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
      {[...robots.all.values()].filter(is_here).map((one) => (
        <circle key={one.ref} class="conditions-robot" cx={one.x} cy={one.y} r={250} />
      ))}
      {people.map((one) => (
        <circle key={one.ref} class="conditions-person" cx={one.x} cy={one.y} r={180} />
      ))}
    </>
  );
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
