// Layout of a graph: layers from the start downwards with few crossings, a place for each label, and back edges beside. Deterministic.
import type { Edge, Graph } from './graph';

export interface Box {
  x: number; // of its centre
  y: number;
  width: number;
  height: number;
}
export interface Point {
  x: number;
  y: number;
}
export interface DrawnEdge {
  edge: Edge;
  /** From the border of one box to that of the other. */
  points: Point[];
  label: Box;
}
export interface Layout {
  width: number;
  height: number;
  boxes: Map<string, Box>;
  edges: DrawnEdge[];
}

export interface Sizes {
  box: (state: string) => { width: number; height: number };
  label: (edge: Edge) => { width: number; height: number };
}

const layer_gap = 15;
const side_gap = 14;
const margin = 12;
const sweeps = 12;

// A state, an edge's label, or a point where a long edge passes a layer.
interface Spot extends Box {
  layer: number;
  order: number;
  above: Spot[];
  below: Spot[];
  /** Preference for standing straight below the spots above. */
  weight: number;
}

export function layout_of(graph: Graph, sizes: Sizes): Layout {
  const { ranks, is_back } = ranked(graph);
  const layers: Spot[][] = [];
  const spot = (layer: number, width: number, height: number, weight: number): Spot => {
    const made: Spot = { layer, order: 0, above: [], below: [], x: 0, y: 0, width, height, weight };
    (layers[layer] ??= []).push(made);
    return made;
  };
  const boxes = new Map(graph.states.map((name) => {
    const { width, height } = sizes.box(name);
    return [name, spot(ranks.get(name)! * 2, width, height, 1)] as const;
  }));
  const chains = graph.edges.map((edge) => ({ edge, chain: chain_of(edge) }));
  for (let i = 0; i < layers.length; ++i) layers[i] ??= [];
  order(layers);
  place(layers);
  for (let round = 0; round < 3; ++round) for (const { chain } of chains) straighten(layers, chain.spots.slice(1, -1));
  shift_to_margin(layers);
  return drawn(layers, boxes, chains);

  // The spots of an edge from the upper to the lower state, including both; its label is between two layers.
  function chain_of(edge: Edge): { spots: Spot[]; label: Spot; is_back: boolean } {
    const back = is_back(edge);
    const [top, bottom] = (back ? [edge.to, edge.from] : [edge.from, edge.to]).map((name) => boxes.get(name)!) as [Spot, Spot];
    const { width, height } = sizes.label(edge);
    if (top === bottom) {
      const label = spot(top.layer + 1, width, height, 1);
      joined(top, label);
      return { spots: [top], label, is_back: false };
    }
    // Near the source, so that the reader sees its outgoing edges.
    const label_layer = back ? bottom.layer - 1 : top.layer + 1;
    const spots: Spot[] = [top];
    let label!: Spot;
    for (let layer = top.layer + 1; layer < bottom.layer; ++layer) {
      const next = layer === label_layer ? spot(layer, width, height, 2) : spot(layer, 6, 0, 4);
      if (layer === label_layer) label = next;
      joined(spots.at(-1)!, next);
      spots.push(next);
    }
    joined(spots.at(-1)!, bottom);
    return { spots: [...spots, bottom], label, is_back: back };
  }
}

function joined(upper: Spot, lower: Spot): void {
  upper.below.push(lower);
  lower.above.push(upper);
}

// Layers by the longest path from the start, ignoring back edges of a depth-first search.
function ranked({ states, start, edges }: Graph): { ranks: Map<string, number>; is_back: (edge: Edge) => boolean } {
  const out = new Map(states.map((name) => [name, edges.filter((one) => one.from === name)]));
  const back = new Set<Edge>();
  const open = new Set<string>();
  const done: string[] = []; // in reverse order of completion
  const visit = (name: string) => {
    open.add(name);
    for (const edge of out.get(name) ?? []) {
      if (open.has(edge.to)) back.add(edge);
      else if (!done.includes(edge.to)) visit(edge.to);
    }
    open.delete(name);
    done.push(name);
  };
  for (const name of [start, ...states]) if (out.has(name) && !done.includes(name)) visit(name);
  const ranks = new Map(states.map((name) => [name, 0]));
  for (const name of done.reverse())
    for (const edge of out.get(name)!) if (!back.has(edge)) ranks.set(edge.to, Math.max(ranks.get(edge.to)!, ranks.get(name)! + 1));
  return { ranks, is_back: (edge) => back.has(edge) && edge.from !== edge.to };
}

// Sweeps down and up, moving each spot to the mean of its neighbours. Keeps the order with the fewest crossings.
function order(layers: Spot[][]): void {
  const number = (layer: Spot[]) => layer.forEach((one, i) => (one.order = i));
  layers.forEach(number);
  let best = layers.map((layer) => [...layer]);
  let fewest = crossings(layers);
  for (let sweep = 0; sweep < sweeps && fewest > 0; ++sweep) {
    const down = sweep % 2 === 0;
    for (const layer of down ? layers : [...layers].reverse()) {
      const mean = new Map(layer.map((one) => [one, mean_of((down ? one.above : one.below).map((other) => other.order)) ?? one.order]));
      layer.sort((a, b) => mean.get(a)! - mean.get(b)! || a.order - b.order);
      number(layer);
    }
    const now = crossings(layers);
    if (now < fewest) [fewest, best] = [now, layers.map((layer) => [...layer])];
  }
  best.forEach((layer, i) => {
    layers[i] = layer;
    number(layer);
  });
}

function mean_of(numbers: readonly number[]): number | undefined {
  return numbers.length === 0 ? undefined : numbers.reduce((sum, one) => sum + one, 0) / numbers.length;
}

function crossings(layers: readonly Spot[][]): number {
  let count = 0;
  for (const layer of layers) {
    const pairs = layer.flatMap((upper) => upper.below.map((lower) => [upper.order, lower.order] as const));
    for (const [i, [a, b]] of pairs.entries()) for (const [c, d] of pairs.slice(i + 1)) if ((a - c) * (b - d) < 0) count += 1;
  }
  return count;
}

// Rows, then columns: each spot moves towards its connected spots as far as there is room.
function place(layers: Spot[][]): void {
  let y = margin;
  for (const layer of layers) {
    const height = Math.max(0, ...layer.map((one) => one.height));
    for (const one of layer) one.y = y + height / 2;
    y += height + layer_gap;
    let x = margin;
    for (const one of layer) {
      one.x = x + one.width / 2;
      x += one.width + side_gap;
    }
  }
  for (let round = 0; round < 40; ++round) {
    const down = round % 2 === 0;
    for (const layer of down ? layers : [...layers].reverse()) {
      const wanted = layer.map((one) => {
        const near = round < 30 ? (down ? one.above : one.below) : [...one.above, ...one.below];
        const weights = near.map((other) => Math.min(one.weight, other.weight));
        const sum = weights.reduce((all, weight) => all + weight, 0);
        return sum === 0 ? one.x : near.reduce((all, other, i) => all + other.x * weights[i]!, 0) / sum;
      });
      settle(layer, wanted);
    }
  }
}

function shift_to_margin(layers: readonly Spot[][]): void {
  const left = Math.min(...layers.flat().map((one) => one.x - one.width / 2));
  for (const one of layers.flat()) one.x += margin - left;
}

// Straightens long edges as far as there is room.
function straighten(layers: readonly Spot[][], spots: readonly Spot[]): void {
  let group: Spot[] = [];
  let [low, high] = [-Infinity, Infinity];
  const settle_group = () => {
    const x = Math.min(high, Math.max(low, mean_of(group.map((one) => one.x)) ?? 0));
    for (const one of group) one.x = x;
  };
  for (const spot of spots) {
    const [left, right] = [layers[spot.layer]![spot.order - 1], layers[spot.layer]![spot.order + 1]];
    const from = left ? left.x + (left.width + spot.width) / 2 + side_gap : -Infinity;
    const to = right ? right.x - (right.width + spot.width) / 2 - side_gap : Infinity;
    if (Math.max(low, from) > Math.min(high, to) + 0.001) {
      settle_group();
      [group, low, high] = [[], -Infinity, Infinity];
    }
    group.push(spot);
    [low, high] = [Math.max(low, from), Math.min(high, to)];
  }
  settle_group();
}

// As near to the wanted positions as possible without overlap: overlapping spots move as a block to their mean.
function settle(layer: Spot[], wanted: readonly number[]): void {
  interface Block {
    spots: number[];
    offsets: number[]; // from the first spot
    sum: number; // of the wanted positions of the first spot
  }
  const blocks: Block[] = [];
  const at = ({ sum, spots }: Block) => sum / spots.length;
  layer.forEach((_, i) => {
    blocks.push({ spots: [i], offsets: [0], sum: wanted[i]! });
    for (let last = blocks.length - 1; last > 0; --last) {
      const [a, b] = [blocks[last - 1]!, blocks[last]!];
      const [end, begin] = [a.spots.at(-1)!, b.spots[0]!];
      const gap = (layer[end]!.width + layer[begin]!.width) / 2 + side_gap;
      const shift = a.offsets.at(-1)! + gap;
      if (at(a) + shift <= at(b)) break;
      blocks.pop();
      a.spots.push(...b.spots);
      a.offsets.push(...b.offsets.map((one) => one + shift));
      a.sum += b.sum - shift * b.spots.length;
    }
  });
  for (const block of blocks) block.spots.forEach((spot, i) => (layer[spot]!.x = at(block) + block.offsets[i]!));
}

function drawn(
  layers: Spot[][],
  boxes: Map<string, Spot>,
  chains: { edge: Edge; chain: { spots: Spot[]; label: Spot; is_back: boolean } }[],
): Layout {
  const all = layers.flat();
  const edges = chains.map(({ edge, chain: { spots, label, is_back } }): DrawnEdge => {
    if (spots.length === 1) return { edge, points: loop(spots[0]!, label), label: box_of(label) };
    const [top, ...between] = spots as [Spot, ...Spot[]];
    const bottom = between.pop()!;
    const points = [port(top, between[0]!, 'below'), ...between.flatMap(through), port(bottom, between.at(-1)!, 'above')];
    return { edge, points: is_back ? points.reverse() : points, label: box_of(label) };
  });
  return {
    width: Math.max(0, ...all.map((one) => one.x + one.width / 2)) + margin,
    height: Math.max(0, ...all.map((one) => one.y + one.height / 2)) + margin,
    boxes: new Map([...boxes].map(([name, spot]) => [name, box_of(spot)])),
    edges,
  };
}

function box_of({ x, y, width, height }: Spot): Box {
  return { x, y, width, height };
}

// Straight through the height of its layer.
function through({ x, y, height }: Spot): Point[] {
  return height === 0 ? [{ x, y }] : [{ x, y: y - height / 2 }, { x, y: y + height / 2 }];
}

// Ports of a box are in the order of the other ends, so that edges do not cross.
function port(box: Spot, other: Spot, side: 'above' | 'below'): Point {
  const neighbours = [...box[side]].sort((a, b) => a.x - b.x);
  const step = Math.min(26, (box.width - 24) / Math.max(1, neighbours.length));
  const x = box.x + (neighbours.indexOf(other) - (neighbours.length - 1) / 2) * step;
  return { x, y: box.y + (side === 'below' ? box.height / 2 : -box.height / 2) };
}

// From a state to itself, around its label.
function loop(box: Spot, label: Spot): Point[] {
  const out = port(box, label, 'below');
  const right = label.x + label.width / 2 + 8;
  return [out, { x: out.x, y: label.y }, { x: right, y: label.y }, { x: right, y: box.y }, { x: box.x + box.width / 2, y: box.y }];
}

/** A path along points with rounded corners. */
export function path_of(points: readonly Point[]): string {
  const [first, ...rest] = points;
  if (!first) return '';
  let path = `M${at(first)}`;
  rest.forEach((point, i) => {
    const before = points[i]!;
    if (point.x === before.x || rest.length === 1) path += `L${at(point)}`;
    else path += `C${at({ x: before.x, y: (before.y + point.y) / 2 })} ${at({ x: point.x, y: (before.y + point.y) / 2 })} ${at(point)}`;
  });
  return path;
}

function at({ x, y }: Point): string {
  return `${Math.round(x * 10) / 10} ${Math.round(y * 10) / 10}`;
}
