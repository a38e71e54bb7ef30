// Places labels beside their things without overlaps.
import type { Size, Point } from '../view';

export interface Label {
  key: string;
  width: number; // px
  at: Point; // of the thing
  radius: number; // of the thing
  /** Shown even if there is no room. */
  must: boolean;
}

/** A rectangle on the screen. */
export interface Place extends Point {
  width: number;
  height: number;
}

const height = 18;
const sides = ['right', 'left', 'below', 'above'] as const;
type Side = (typeof sides)[number];

/** Remembers the side of each label, so that it does not jump. */
export class Labels {
  private readonly sides = new Map<string, Side>();

  /** The boxes by key, in order of priority. Labels without room are missing. */
  placed(labels: readonly Label[], size: Size, before: readonly Place[] = []): Map<string, Place> {
    const places = new Map<string, Place>();
    const taken = [...before];
    for (const label of labels) {
      const usual = this.sides.get(label.key);
      const order = usual === undefined ? sides : [usual, ...sides.filter((one) => one !== usual)];
      const free = order.find((side) => is_free(place_at(label, side), taken, size));
      const side = free ?? (label.must ? order[0] : undefined);
      if (side === undefined) continue;
      this.sides.set(label.key, side);
      const place = place_at(label, side);
      taken.push(place);
      places.set(label.key, place);
    }
    if (this.sides.size > 4 * labels.length + 40) this.sides.clear();
    return places;
  }
}

function place_at({ at, width, radius }: Label, side: Side): Place {
  const away = radius + 5;
  switch (side) {
    case 'right':
      return { x: at.x + away, y: at.y - height / 2, width, height };
    case 'left':
      return { x: at.x - away - width, y: at.y - height / 2, width, height };
    case 'below':
      return { x: at.x - width / 2, y: at.y + away, width, height };
    case 'above':
      return { x: at.x - width / 2, y: at.y - away - height, width, height };
  }
}

function is_free(one: Place, taken: readonly Place[], size: Size): boolean {
  if (one.x < 0 || one.y < 0 || one.x + one.width > size.width || one.y + one.height > size.height) return false;
  return !taken.some(
    (other) =>
      one.x < other.x + other.width && other.x < one.x + one.width && one.y < other.y + other.height && other.y < one.y + one.height,
  );
}
