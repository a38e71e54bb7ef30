// The canvas with its pointer, wheel and key input.
import { useSignal } from '@preact/signals';
import { useEffect, useMemo, useRef } from 'preact/hooks';

import { useConsole } from '../context';
import { shown_theme } from '../shell/theme';
import { watch_size } from '../ui';
import { is_map_key } from './interaction';
import { Drawing } from './painting/drawing';
import { read_palette } from './painting/palette';
import { age, metres, position } from './formats';
import { session_of } from './session';
import * as texts from './texts';
import type { Point } from './view';

export interface BoardProps {
  /** Called with the drawing when it exists, with undefined when it is removed. */
  begun: (drawing: Drawing | undefined) => void;
  /** Called with the pointer's position on the floor. */
  pointed: (at: Point | undefined) => void;
  /** Ctrl+Enter. */
  send: () => void;
}

export function Board({ begun, pointed, send }: BoardProps) {
  const console = useConsole();
  const session = session_of(console);
  const element = useRef<HTMLCanvasElement>(null);
  const drawing = useRef<Drawing>();
  const announcement = useSignal('');

  useEffect(() => {
    const canvas = element.current!;
    const board_drawing = new Drawing(console, session, canvas, {
      make_sheet: () => document.createElement('canvas'),
      read_palette,
      theme: () => shown_theme.value,
      age_text: age,
      distance_text: (mm) => metres(mm, 1),
    });
    drawing.current = board_drawing;
    const stops = [
      board_drawing.start(),
      follow_size(canvas, board_drawing),
      follow_query('(prefers-reduced-motion: reduce)', (is_so) => (board_drawing.is_still = is_so)),
    ];
    begun(board_drawing);
    return () => {
      for (const stop of stops) stop();
      begun(undefined);
    };
  }, []);

  const pointers = useMemo(() => {
    const at = (event: PointerEvent | WheelEvent): Point => ({ x: event.offsetX, y: event.offsetY });
    const pointer = (kind: 'move' | 'release') => (event: PointerEvent) => {
      drawing.current!.act({ kind, pointer: event.pointerId, at: at(event) });
      if (kind === 'move') point_at(event.pointerType === 'mouse' ? at(event) : undefined);
    };
    return {
      onPointerDown: (event: PointerEvent) => {
        if (event.button > 1) return;
        (event.currentTarget as HTMLElement).setPointerCapture(event.pointerId);
        drawing.current!.is_coarse = event.pointerType === 'touch';
        drawing.current!.act({ kind: 'press', pointer: event.pointerId, at: at(event), aims: event.shiftKey && event.button === 0 });
      },
      onPointerMove: pointer('move'),
      onPointerUp: pointer('release'),
      onPointerCancel: (event: PointerEvent) => drawing.current!.act({ kind: 'cancel', pointer: event.pointerId }),
      onPointerLeave: () => point_at(undefined),
      onWheel: (event: WheelEvent) => {
        event.preventDefault();
        const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 16 : 1;
        drawing.current!.act({ kind: 'wheel', at: at(event), factor: Math.exp(-event.deltaY * lines * (event.ctrlKey ? 0.01 : 0.0016)) });
      },
    };
  }, []);

  function point_at(at: Point | undefined): void {
    const hit = at && drawing.current!.hit(at);
    session.hovered.value = hit?.what === 'thing' ? hit.key : undefined;
    element.current!.dataset['over'] = hit?.what ?? '';
    pointed(at && drawing.current!.floor_at(at));
  }

  function pressed(event: KeyboardEvent): void {
    if (!is_map_key(event)) return;
    event.preventDefault();
    if (event.key === 'Enter' && event.ctrlKey) return send();
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    drawing.current!.act({ kind: 'key', key, shift: event.shiftKey, ctrl: event.ctrlKey });
    announcement.value = spoken();
  }

  // For screen readers: the cursor's position and the things near it.
  function spoken(): string {
    const { cursor } = session.interaction.value;
    if (!cursor) return '';
    const near = drawing
      .current!.near(cursor)
      .slice(0, 3)
      .map((one) => texts.near(one.name, metres(Math.hypot(one.x - cursor.x, one.y - cursor.y), 1)));
    return [position(cursor), ...near].join('; ');
  }

  return (
    <>
      <canvas
        ref={element}
        class="map-canvas"
        tabIndex={0}
        role="application"
        aria-label={texts.canvas()}
        onKeyDown={pressed}
        {...pointers}
      />
      <p class="unseen" role="status">
        {announcement.value}
      </p>
    </>
  );
}

function follow_size(canvas: HTMLCanvasElement, drawing: Drawing): () => void {
  const measure = () => drawing.resize({ width: canvas.clientWidth, height: canvas.clientHeight }, devicePixelRatio);
  return watch_size(canvas, measure);
}

function follow_query(query: string, changed: (is_so: boolean) => void): () => void {
  const list = matchMedia(query);
  const report = () => changed(list.matches);
  list.addEventListener('change', report);
  report();
  return () => list.removeEventListener('change', report);
}
