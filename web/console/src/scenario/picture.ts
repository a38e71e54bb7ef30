// Sizes and shapes of the diagram, independent of the page.
import { type Edge, graph_of, label_of_edge } from './graph';
import { type Box, type DrawnEdge, type Layout, layout_of, type Point } from './layout';
import type { Scenario } from './model';

const letter = 0.6; // average width of a letter, relative to the font size

export function shown_name(name: string): string {
  return name.replaceAll('_', ' ');
}

const sizes = {
  box: (name: string) => ({ width: Math.max(84, Math.round(shown_name(name).length * 13 * letter) + 56), height: 32 }),
  label: (edge: Edge) => ({ width: Math.round(label_of_edge(edge).length * 11 * letter) + 14, height: 17 }),
};

const known = new WeakMap<Scenario, Layout>();

/** Computed once for each scenario. */
export function picture_of(scenario: Scenario): Layout {
  const picture = known.get(scenario) ?? layout_of(graph_of(scenario), sizes);
  known.set(scenario, picture);
  return picture;
}

/** The arrow head at the end of an edge. */
export function arrow_head({ points }: DrawnEdge): string {
  const [before, end] = [points.at(-2)!, points.at(-1)!];
  const sideways = before.y === end.y;
  const [dx, dy] = sideways ? [Math.sign(end.x - before.x), 0] : [0, Math.sign(end.y - before.y)];
  const back = { x: end.x - dx * 8, y: end.y - dy * 8 };
  return `M${end.x} ${end.y}L${back.x - dy * 4} ${back.y - dx * 4}L${back.x + dy * 4} ${back.y + dx * 4}Z`;
}

/** The state in the direction of an arrow key: the nearest that lies more in that direction than aside. */
export function neighbour(boxes: ReadonlyMap<string, Box>, from: string, key: string): string | undefined {
  const way = (
    { ArrowUp: { x: 0, y: -1 }, ArrowDown: { x: 0, y: 1 }, ArrowLeft: { x: -1, y: 0 }, ArrowRight: { x: 1, y: 0 } } as Record<string, Point>
  )[key];
  const start = boxes.get(from);
  if (!way || !start) return undefined;
  let nearest: { name: string; cost: number } | undefined;
  for (const [name, box] of boxes) {
    const [dx, dy] = [box.x - start.x, box.y - start.y];
    const ahead = dx * way.x + dy * way.y;
    const aside = Math.abs(dx * way.y) + Math.abs(dy * way.x);
    if (name === from || ahead < 1 || (way.x !== 0 && aside > ahead * 2)) continue;
    const cost = ahead + aside * 2;
    if (!nearest || cost < nearest.cost) nearest = { name, cost };
  }
  return nearest?.name;
}
