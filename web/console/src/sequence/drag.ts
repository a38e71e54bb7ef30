// Dragging steps with the mouse. Touch scrolls the drawing; there are buttons for moving.
import { useRef, useState } from 'preact/hooks';

import type { Slot } from './model';

const begins_after = 6; // px

export interface Drag {
  /** The dragged step, if any. */
  dragged: number | undefined;
  over: Slot | undefined;
  /** The event handlers of a step. */
  handlers(step: number): {
    onPointerDown(event: PointerEvent): void;
    onPointerMove(event: PointerEvent): void;
    onPointerUp(event: PointerEvent): void;
    onPointerCancel(): void;
  };
}

export function useDrag(drop: (step: number, to: Slot) => void): Drag {
  const pressed = useRef<{ step: number; x: number; y: number } | undefined>();
  const [dragged, set_dragged] = useState<number>();
  const [over, set_over] = useState<Slot>();
  const end = () => {
    pressed.current = undefined;
    set_dragged(undefined);
    set_over(undefined);
  };
  return {
    dragged,
    over,
    handlers: (step) => ({
      onPointerDown: (event) => {
        if (event.button === 0 && event.pointerType !== 'touch') pressed.current = { step, x: event.clientX, y: event.clientY };
      },
      onPointerMove: (event) => {
        const from = pressed.current;
        if (!from) return;
        if (dragged === undefined) {
          if (Math.hypot(event.clientX - from.x, event.clientY - from.y) < begins_after) return;
          (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId);
          set_dragged(from.step);
        }
        set_over(slot_at(event.clientX, event.clientY));
      },
      onPointerUp: (event) => {
        const to = slot_at(event.clientX, event.clientY);
        if (dragged !== undefined && to) drop(dragged, to);
        end();
      },
      onPointerCancel: end,
    }),
  };
}

// The place under the mouse: a gap, or the nearer side of a step.
function slot_at(x: number, y: number): Slot | undefined {
  const element = document.elementFromPoint(x, y);
  const gap = element?.closest<HTMLElement>('[data-slot]') ?? side_of(element?.closest<HTMLElement>('.sequence-item'), x);
  const [lane, index] = (gap?.dataset['slot'] ?? '').split(' ').map(Number);
  return lane === undefined || index === undefined ? undefined : { lane, index };
}

function side_of(item: HTMLElement | null | undefined, x: number): HTMLElement | undefined {
  if (!item) return undefined;
  const box = item.getBoundingClientRect();
  const one = x < box.left + box.width / 2 ? item : item.nextElementSibling;
  return one?.querySelector<HTMLElement>(':scope > [data-slot]') ?? undefined;
}
