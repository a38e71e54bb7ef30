// Drawing tools: a canvas in CSS pixels and the floor's transformation.
import { type Point, type Size, to_screen, type View } from '../view';
import type { Palette } from './palette';

export type Context = CanvasRenderingContext2D;

export class Pen {
  constructor(
    readonly context: Context,
    readonly view: View,
    readonly size: Size,
    readonly palette: Palette,
  ) {}

  at(point: Point): Point {
    return to_screen(this.view, this.size, point);
  }

  length(mm: number): number {
    return mm * this.view.scale;
  }

  circle({ x, y }: Point, radius: number): void {
    this.context.beginPath();
    this.context.arc(x, y, radius, 0, 2 * Math.PI);
  }

  line(from: Point, to: Point): void {
    this.context.beginPath();
    this.context.moveTo(from.x, from.y);
    this.context.lineTo(to.x, to.y);
  }

  /** A triangle on the x axis that points along it. Its base is `length` before the tip. */
  arrow(tip: number, length: number, half_width: number): void {
    this.context.beginPath();
    this.context.moveTo(tip, 0);
    this.context.lineTo(tip - length, -half_width);
    this.context.lineTo(tip - length, half_width);
    this.context.closePath();
  }

  /** Draws with the origin at a screen point and x in a direction of the floor in degrees. */
  turned({ x, y }: Point, degrees: number, draw: () => void): void {
    this.context.save();
    this.context.translate(x, y);
    this.context.rotate((-degrees * Math.PI) / 180);
    draw();
    this.context.restore();
  }

  fill(style: string, alpha = 1): void {
    this.context.globalAlpha = alpha;
    this.context.fillStyle = style;
    this.context.fill();
    this.context.globalAlpha = 1;
  }

  stroke(style: string, width: number, alpha = 1): void {
    this.context.globalAlpha = alpha;
    this.context.strokeStyle = style;
    this.context.lineWidth = width;
    this.context.stroke();
    this.context.globalAlpha = 1;
  }

  dashed(...pattern: number[]): void {
    this.context.setLineDash(pattern);
  }

  text(text: string, { x, y }: Point, style: string, align: CanvasTextAlign = 'left'): void {
    this.context.textAlign = align;
    this.context.fillStyle = style;
    this.context.fillText(text, x, y);
  }
}
