// Marks of an axis.
import { clock_time } from '../../i18n/i18n';

export interface AxisMark {
  at: number;
  text: string;
}

const second = 1000;
const minute = 60 * second;
const hour = 60 * minute;
const steps = [
  10, 20, 50, 100, 200, 500, second, 2 * second, 5 * second, 10 * second, 15 * second, 30 * second,
  minute, 2 * minute, 5 * minute, 10 * minute, 15 * minute, 30 * minute, hour, 2 * hour, 3 * hour, 6 * hour, 12 * hour, 24 * hour,
];

/** Round times in the browser's time zone, at least `least` ms apart; ms since 1970. */
export function time_marks(from: number, to: number, least: number): AxisMark[] {
  const step = steps.find((one) => one >= least) ?? Math.ceil(least / (24 * hour)) * 24 * hour;
  const zone = new Date(from).getTimezoneOffset() * minute;
  const marks: AxisMark[] = [];
  for (let at = Math.ceil((from - zone) / step) * step + zone; at <= to; at += step) marks.push({ at, text: time_text(at, step) });
  return marks;
}

function time_text(at: number, step: number): string {
  if (step >= minute) return clock_time(at, false).slice(0, 5);
  if (step >= second) return clock_time(at, false);
  return clock_time(at).slice(3, step < 100 ? 11 : 10);
}

/** Round values from 0 to at least `most`; `count` or a few more. */
export function value_marks(most: number, count: number): number[] {
  const rough = (most > 0 ? most : 1) / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((one) => one * power).find((one) => one >= rough * 0.999)!;
  const marks = [0];
  while (marks.at(-1)! < most || marks.length < 2) marks.push(Number((marks.length * step).toPrecision(12)));
  return marks;
}
