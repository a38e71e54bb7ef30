// Converts measurements to the lines of a plot.
import type { Scrape } from '../state/engine/metrics_state';
import { median, type Second } from '../state/session/traffic';

export interface Point {
  at: number; // ms since 1970
  value: number;
}

/** Points in order. A distance above `longest_gap` means that nothing was measured. */
export type Series = readonly Point[];

/** Time shown in a plot. */
export const shown_for = 60_000; // ms
/** Maximum age of a current value. */
export const fresh_for = 5000; // ms
export const longest_gap = 2600; // ms

const since = <T extends { at: number }>(all: Iterable<T>, from: number) => [...all].filter((one) => one.at >= from);

/** Response times in ms: median and maximum of each second. */
export function latencies(seconds: Iterable<Second>, from: number): { middle: Series; slowest: Series } {
  const measured = since(seconds, from).filter((one) => one.tooks.length > 0);
  return {
    middle: measured.map(({ at, tooks }) => ({ at, value: median(tooks)! })),
    slowest: measured.map(({ at, tooks, slowest }) => ({ at, value: slowest?.took ?? Math.max(...tooks) })),
  };
}

/** Documents in each whole second; 0 for seconds without documents. */
export function documents_a_second(seconds: Iterable<Second>, from: number, now: number, count: (one: Second) => number): Series {
  const all = [...seconds];
  const by_time = new Map(all.map((one) => [one.at, one]));
  const first = Math.max(Math.ceil(from / 1000) * 1000, all[0]?.at ?? now);
  const points: Point[] = [];
  for (let at = first; at + 1000 <= now; at += 1000) points.push({ at, value: count(by_time.get(at) ?? nothing) });
  return points;
}
const nothing: Second = { at: 0, sent: 0, received: 0, tooks: [] };

/** Growth of a counter per second between two samples. A decrease means that the gateway was restarted. */
export function growth(history: Iterable<Scrape>, from: number, count: (scrape: Scrape) => number | undefined): Series {
  const points: Point[] = [];
  let before: Point | undefined;
  for (const scrape of history) {
    const value = count(scrape);
    if (value === undefined) continue;
    if (before && scrape.at > before.at && scrape.at - before.at <= longest_gap && value >= before.value && scrape.at >= from)
      points.push({ at: scrape.at, value: ((value - before.value) / (scrape.at - before.at)) * 1000 });
    before = { at: scrape.at, value };
  }
  return points;
}

/** Average time of a request inside the gateway between two samples, in ms. */
export function inside(history: Iterable<Scrape>, from: number): Series {
  const all = [...history];
  const sums = growth(all, from, (one) => one.value('rois_request_duration_seconds_sum'));
  const counts = new Map(growth(all, from, (one) => one.value('rois_request_duration_seconds_count')).map((one) => [one.at, one.value]));
  return sums.flatMap(({ at, value }) => ((counts.get(at) ?? 0) > 0 ? [{ at, value: (value / counts.get(at)!) * 1000 }] : []));
}

/** The point nearest in time, within `longest_gap`. */
export function point_near(series: Series, at: number): Point | undefined {
  let best: Point | undefined;
  for (const point of series) if (!best || Math.abs(point.at - at) < Math.abs(best.at - at)) best = point;
  return best && Math.abs(best.at - at) <= longest_gap / 2 ? best : undefined;
}

export function highest(series: Series): number | undefined {
  return series.length === 0 ? undefined : Math.max(...series.map((one) => one.value));
}
