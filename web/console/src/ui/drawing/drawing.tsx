// A canvas that fills its frame: sharp on every screen, and drawn at most once a frame, on request.
import { type RefObject } from 'preact';
import { useCallback, useLayoutEffect, useRef } from 'preact/hooks';

import { watch_size } from '../use_width';

/** The drawing surface; lengths in CSS pixels. */
export interface Sheet {
  pen: CanvasRenderingContext2D;
  width: number;
  height: number;
  /** A custom property of tokens.css in the current theme. */
  color: (name: `--${string}`) => string;
}

export interface Drawing {
  canvas: RefObject<HTMLCanvasElement>;
  redraw: () => void;
}

/** Redraws after each render of the component, when the size changes, and on `redraw`. */
export function useDrawing(draw: (sheet: Sheet) => void): Drawing {
  const canvas = useRef<HTMLCanvasElement>(null);
  const latest = useRef(draw);
  const asked = useRef(0);
  latest.current = draw;
  const redraw = useCallback(() => {
    asked.current ||= requestAnimationFrame(() => {
      asked.current = 0;
      if (canvas.current) draw_on(canvas.current, latest.current);
    });
  }, []);
  useLayoutEffect(redraw);
  useLayoutEffect(() => {
    const end = watch_size(canvas.current!, redraw);
    return () => {
      end();
      cancelAnimationFrame(asked.current);
      asked.current = 0;
    };
  }, []);
  return { canvas, redraw };
}

function draw_on(canvas: HTMLCanvasElement, draw: (sheet: Sheet) => void): void {
  const { clientWidth: width, clientHeight: height } = canvas;
  const pen = canvas.getContext('2d');
  if (!pen || width === 0 || height === 0) return;
  const fine = devicePixelRatio || 1;
  const [columns, rows] = [Math.round(width * fine), Math.round(height * fine)];
  if (canvas.width !== columns || canvas.height !== rows) [canvas.width, canvas.height] = [columns, rows];
  const style = getComputedStyle(canvas);
  pen.setTransform(fine, 0, 0, fine, 0, 0);
  pen.clearRect(0, 0, width, height);
  draw({ pen, width, height, color: (name) => style.getPropertyValue(name).trim() });
}
