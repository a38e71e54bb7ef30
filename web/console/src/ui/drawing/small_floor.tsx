// A small SVG floor map to point at. Its content is in mm with y downwards.
import type { ComponentChildren, JSX, Ref } from 'preact';

import { ground_of, type Point } from '../../state/floor/floor';
import type { Bounds, FloorMap } from '../../state/floor/floor_map';

const margin = 200; // mm

interface SmallFloorProps extends Omit<JSX.SVGAttributes<SVGSVGElement>, 'map' | 'ref'> {
  svg: Ref<SVGSVGElement>;
  bounds: Bounds;
  map: FloorMap | undefined;
  children: ComponentChildren;
}

export function SmallFloor({ svg, bounds, map, children, ...more }: SmallFloorProps) {
  const { x, y, width, depth } = bounds;
  return (
    <svg {...more} ref={svg} class="floor" viewBox={`${x - margin} ${-y - depth - margin} ${width + 2 * margin} ${depth + 2 * margin}`}>
      <g aria-hidden="true">
        <g transform="scale(1 -1)">
          <rect class="floor-ground" {...rect(bounds)} />
          {map?.places.map((one) => <rect key={one.name} class="floor-place" {...rect(ground_of(one))} rx={120} />)}
          {map?.furniture.map((one, i) => <rect key={i} class="floor-furniture" {...rect(one)} />)}
          {map?.walls.map((one, i) => <line key={i} class="floor-wall" {...one} />)}
          {!map && metres(x, width).map((at) => <line key={at} class="floor-grid" x1={at} x2={at} y1={y} y2={y + depth} />)}
          {!map && metres(y, depth).map((at) => <line key={at} class="floor-grid" x1={x} x2={x + width} y1={at} y2={at} />)}
        </g>
        {map?.places.map((one) => (
          <text key={one.name} class="floor-place-name" x={one.x} y={-one.y + 110}>
            {one.name.replaceAll('_', ' ')}
          </text>
        ))}
      </g>
      {children}
    </svg>
  );
}

/** The position of a pointer on the floor. */
export function floor_point(svg: SVGSVGElement, { clientX, clientY }: MouseEvent): Point {
  const { x, y } = new DOMPoint(clientX, clientY).matrixTransform(svg.getScreenCTM()!.inverse());
  return { x, y: -y };
}

/** A box as attributes of a `rect`. */
export function rect({ x, y, width, depth }: Bounds) {
  return { x, y, width, height: depth };
}

function metres(from: number, length: number): number[] {
  return Array.from({ length: Math.floor(length / 1000) + 1 }, (_, i) => (Math.ceil(from / 1000) + i) * 1000);
}
