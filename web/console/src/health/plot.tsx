// A plot of the last minute. A legend shows the values under the pointer; keys move along the lines; a table has the same data.
import { type Signal, useSignal } from '@preact/signals';
import { useRef } from 'preact/hooks';

import { clock_time } from '../i18n/i18n';
import { shown_theme } from '../shell/theme';
import { type Sheet, Table, time_marks, useDrawing, value_marks } from '../ui';
import { fresh_for, highest, longest_gap, point_near, type Series, shown_for } from './series';
import * as texts from './texts';

/** Lines differ in colour and dash pattern. */
export type Ink = 'first' | 'second' | 'third';

export interface Line {
  name: string;
  ink: Ink;
  series: Series;
}

export interface PlotProps {
  title: string;
  lines: readonly Line[];
  now: number; // the right edge, ms since 1970
  /** Formats a value with its unit. */
  text: (value: number) => string;
  /** Formats a value of the axis. */
  short: (value: number) => string;
  /** The time under the pointer, shared by all plots. */
  cursor: Signal<number | undefined>;
}

const colors: Record<Ink, `--${string}`> = { first: '--draw-robot', second: '--draw-person', third: '--draw-sound' };
const dashes: Record<Ink, number[]> = { first: [], second: [5, 3], third: [1.5, 2.5] };
const edge = { right: 8, top: 8, bottom: 18 };

export function Plot({ title, lines, now, text, short, cursor }: PlotProps) {
  void shown_theme.value;
  const from = now - shown_for;
  const pointed = cursor.value !== undefined && cursor.value >= from ? cursor.value : undefined;
  const is_open = useSignal(false);
  const left = useRef(0); // px, left end of the lines
  const { canvas } = useDrawing((sheet) => (left.current = draw(sheet, { lines, from, now, short, pointed })));
  const point_at = (event: PointerEvent) => {
    const box = canvas.current!.getBoundingClientRect();
    const share = (event.clientX - box.left - left.current) / (box.width - left.current - edge.right);
    cursor.value = from + Math.max(0, Math.min(1, share)) * shown_for;
  };
  const pressed = (event: KeyboardEvent) => {
    const at = pointed ?? now;
    const to = { ArrowLeft: at - 1000, ArrowRight: at + 1000, PageUp: at - 10_000, PageDown: at + 10_000, Home: from, End: now }[event.key];
    if (event.key === 'Escape') cursor.value = undefined;
    if (to === undefined) return;
    event.preventDefault();
    cursor.value = Math.max(from, Math.min(now, to));
  };
  const value_at = (line: Line) => {
    const last = line.series.at(-1);
    const point = pointed !== undefined ? point_near(line.series, pointed) : last && now - last.at <= fresh_for ? last : undefined;
    return point === undefined ? texts.none() : text(point.value);
  };
  const values = lines.map((line) => `${line.name} ${value_at(line)}`).join(', ');
  const summary = ({ name, series }: Line) => texts.summary(name, series.length === 0 ? texts.none() : text(highest(series)!));
  return (
    <figure class="health-plot">
      <figcaption>
        <h4>{title}</h4>
        <ul class="health-legend">
          {lines.map((line) => (
            <li key={line.name}>
              <Swatch ink={line.ink} />
              <span>{line.name}</span>
              <strong>{value_at(line)}</strong>
            </li>
          ))}
        </ul>
      </figcaption>
      <div
        class="health-canvas"
        role="slider"
        tabIndex={0}
        aria-label={`${title}: ${lines.map(summary).join('; ')}`}
        aria-orientation="horizontal"
        aria-valuemin={-shown_for / 1000}
        aria-valuemax={0}
        aria-valuenow={Math.round(((pointed ?? now) - now) / 1000)}
        aria-valuetext={`${clock_time(pointed ?? now, false)}: ${values}`}
        onKeyDown={pressed}
        onBlur={() => (cursor.value = undefined)}
      >
        <canvas ref={canvas} aria-hidden="true" onPointerMove={point_at} onPointerLeave={() => (cursor.value = undefined)} />
        {pointed !== undefined && <span class="health-time" aria-hidden="true">{clock_time(pointed, false)}</span>}
      </div>
      <details onToggle={(event) => (is_open.value = event.currentTarget.open)}>
        <summary>{texts.as_table()}</summary>
        {is_open.value && <Values title={title} lines={lines} now={now} text={text} />}
      </details>
    </figure>
  );
}

function Swatch({ ink }: { ink: Ink }) {
  return (
    <svg class={`health-swatch health-ink-${ink}`} width="18" height="8" aria-hidden="true">
      <path d="M0 4h18" stroke-dasharray={dashes[ink].join(' ') || 'none'} />
    </svg>
  );
}

// Every five seconds, newest first.
function Values({ title, lines, now, text }: Pick<PlotProps, 'title' | 'lines' | 'now' | 'text'>) {
  const times = Array.from({ length: 13 }, (_, i) => now - i * 5000);
  return (
    <Table
      label={texts.values_of(title)}
      rows={times}
      key_of={(at) => Math.round((now - at) / 1000)}
      columns={[
        { id: 'at', title: texts.time(), cell: (at) => clock_time(at, false) },
        ...lines.map((line) => ({
          id: line.name,
          title: line.name,
          numeric: true,
          cell: (at: number) => {
            const point = point_near(line.series, at);
            return point ? text(point.value) : texts.none();
          },
        })),
      ]}
    />
  );
}

interface Drawn {
  lines: readonly Line[];
  from: number;
  now: number;
  short: (value: number) => string;
  pointed: number | undefined;
}

// Returns the left end of the lines, right of the axis labels.
function draw({ pen, width, height, color }: Sheet, { lines, from, now, short, pointed }: Drawn): number {
  const marks = value_marks(Math.max(0, ...lines.map((line) => highest(line.series) ?? 0)), 3);
  pen.font = `11px ${color('--sans')}`;
  const left = Math.ceil(Math.max(20, ...marks.map((mark) => pen.measureText(short(mark)).width))) + 6;
  const [room, high] = [width - left - edge.right, height - edge.top - edge.bottom];
  const top = marks.at(-1)!;
  const x_of = (at: number) => left + ((at - from) / (now - from)) * room;
  const y_of = (value: number) => edge.top + high - (value / top) * high;
  pen.fillStyle = color('--ink-soft');
  pen.strokeStyle = color('--draw-grid');
  pen.textBaseline = 'middle';
  pen.textAlign = 'right';
  for (const mark of marks) {
    stroke(pen, [left, y_of(mark), width - edge.right, y_of(mark)]);
    pen.fillText(short(mark), left - 5, y_of(mark));
  }
  pen.textAlign = 'center';
  for (const { at, text } of time_marks(from, now, ((now - from) / room) * 80)) {
    stroke(pen, [x_of(at), edge.top, x_of(at), edge.top + high]);
    const half = pen.measureText(text).width / 2;
    if (x_of(at) - half >= 0 && x_of(at) + half <= width) pen.fillText(text, x_of(at), height - edge.bottom / 2);
  }
  pen.save();
  pen.beginPath();
  pen.rect(left, 0, room, height);
  pen.clip();
  pen.lineJoin = 'round';
  for (const { ink, series } of lines) {
    pen.strokeStyle = pen.fillStyle = color(colors[ink]);
    pen.lineWidth = 1.6;
    pen.setLineDash(dashes[ink]);
    pen.beginPath();
    series.forEach((point, i) => {
      const [x, y] = [x_of(point.at), y_of(point.value)];
      const before = series[i - 1];
      const after = series[i + 1];
      const is_joined = before !== undefined && point.at - before.at <= longest_gap;
      if (is_joined) pen.lineTo(x, y);
      else pen.moveTo(x, y);
      if (!is_joined && (after === undefined || after.at - point.at > longest_gap)) pen.rect(x - 1, y - 1, 2, 2); // an isolated point
    });
    pen.stroke();
    pen.setLineDash([]);
    const point = pointed === undefined ? undefined : point_near(series, pointed);
    if (!point) continue;
    pen.beginPath();
    pen.arc(x_of(point.at), y_of(point.value), 3.5, 0, 2 * Math.PI);
    pen.fill();
  }
  if (pointed !== undefined) {
    pen.lineWidth = 1;
    pen.strokeStyle = color('--ink-soft');
    stroke(pen, [x_of(pointed), edge.top, x_of(pointed), edge.top + high]);
  }
  pen.restore();
  return left;
}

function stroke(pen: CanvasRenderingContext2D, [x1, y1, x2, y2]: [number, number, number, number]): void {
  pen.beginPath();
  pen.moveTo(Math.round(x1) + 0.5, Math.round(y1) + 0.5);
  pen.lineTo(Math.round(x2) + 0.5, Math.round(y2) + 0.5);
  pen.stroke();
}
