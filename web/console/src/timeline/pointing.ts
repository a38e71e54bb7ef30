// Pointers on the time line: dragging selects a range or moves the time (on the axis, with Shift, by touch); two fingers zoom; a click
// opens.
import { axis_height } from './paint';
import type { Range, TimeView } from './view';

export interface PointingHost {
  view: TimeView;
  width: () => number; // px
  time_at: (x: number) => number;
  choose: (range: Range | undefined) => void;
  click: (event: PointerEvent) => void;
}

const least_drag = 5; // px; less is a click

export class Pointing {
  private readonly fingers = new Map<number, number>(); // x by pointer id
  private begun: { x: number; at: number; moves: boolean; is_drag: boolean } | undefined;

  constructor(private readonly host: PointingHost) {}

  down(event: PointerEvent): void {
    if (event.button !== 0) return;
    const element = event.currentTarget as HTMLElement;
    element.setPointerCapture(event.pointerId);
    const x = event.offsetX;
    this.fingers.set(event.pointerId, x);
    const is_second = this.fingers.size > 1;
    if (is_second) this.host.choose(undefined);
    this.begun = {
      x,
      at: this.host.time_at(x),
      moves: is_second || event.pointerType === 'touch' || event.shiftKey || event.offsetY < axis_height,
      is_drag: is_second,
    };
  }

  /** Returns whether it is a drag. */
  move(event: PointerEvent): boolean {
    const { begun, host } = this;
    const before = this.fingers.get(event.pointerId);
    if (!begun || before === undefined) return false;
    const x = event.offsetX;
    if (this.fingers.size === 2) this.pinch(event.pointerId, before, x);
    else if (begun.is_drag || Math.abs(x - begun.x) >= least_drag) {
      begun.is_drag = true;
      if (begun.moves) host.view.move(((before - x) / host.width()) * host.view.stretch.peek().span);
      else host.choose(ordered(begun.at, host.time_at(Math.max(0, Math.min(host.width(), x)))));
    } else return true;
    this.fingers.set(event.pointerId, x);
    return true;
  }

  up(event: PointerEvent): void {
    const { begun, host } = this;
    const was_there = this.fingers.delete(event.pointerId);
    if (!was_there || !begun || this.fingers.size > 0) return;
    this.begun = undefined;
    if (!begun.is_drag) return host.click(event);
    host.choose(undefined);
    if (begun.moves) return;
    const { from, to } = ordered(begun.at, host.time_at(Math.max(0, Math.min(host.width(), event.offsetX))));
    host.view.show(from, to);
  }

  cancel(): void {
    this.fingers.clear();
    this.begun = undefined;
    this.host.choose(undefined);
  }

  private pinch(id: number, before: number, x: number): void {
    const other = [...this.fingers].find(([one]) => one !== id)![1];
    const [was, is] = [Math.max(20, Math.abs(before - other)), Math.max(20, Math.abs(x - other))];
    this.host.view.zoom(was / is, this.host.time_at((x + other) / 2));
  }
}

function ordered(one: number, other: number): Range {
  return { from: Math.min(one, other), to: Math.max(one, other) };
}
