// From what was measured to lines in a plot.
import type { Scrape } from '../state/metrics_state';
import { median, type Second } from '../state/traffic';

export interface Point {
  at: number; // ms since 1970
  value: number;
}

/** Points in order. Where the next one is farther away than `longest_gap`, nothing was measured. */
export type Series = readonly Point[];

/** What a plot shows. */
export const shown_for = 60_000; // ms
/** An older value is not that of now. */
export const fresh_for = 5000; // ms
export const longest_gap = 2600; // ms

const since = <T extends { at: number }>(all: Iterable<T>, from: number) => [...all].filter((one) => one.at >= from);

/** How long answers took, in ms: the middle one and the slowest of each second. */
export function latencies(seconds: Iterable<Second>, from: number): { middle: Series; slowest: Series } {
  const those = since(seconds, from).filter((one) => one.tooks.length > 0);
  return {
    middle: those.map(({ at, tooks }) => ({ at, value: median(tooks)! })),
    slowest: those.map(({ at, tooks, slowest }) => ({ at, value: slowest?.took ?? Math.max(...tooks) })),
  };
}

/** Documents of each whole second; a second in which there were none counts as 0. */
export function documents_a_second(seconds: Iterable<Second>, from: number, now: number, count: (one: Second) => number): Series {
  const all = [...seconds];
  const by_time = new Map(all.map((one) => [one.at, one]));
  const first = Math.max(Math.ceil(from / 1000) * 1000, all[0]?.at ?? now);
  const points: Point[] = [];
  for (let at = first; at + 1000 <= now; at += 1000) points.push({ at, value: count(by_time.get(at) ?? nothing) });
  return points;
}
const nothing: Second = { at: 0, sent: 0, received: 0, tooks: [] };

/** How much a counter has grown in a second, between one look and the next. A gateway that was started anew counts from 0. */
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

/** What a request took inside the gateway, in ms, on average between one look and the next. */
export function inside(history: Iterable<Scrape>, from: number): Series {
  const all = [...history];
  const sums = growth(all, from, (one) => one.value('rois_request_duration_seconds_sum'));
  const counts = new Map(growth(all, from, (one) => one.value('rois_request_duration_seconds_count')).map((one) => [one.at, one.value]));
  return sums.flatMap(({ at, value }) => ((counts.get(at) ?? 0) > 0 ? [{ at, value: (value / counts.get(at)!) * 1000 }] : []));
}

/** The point that is nearest in time, if there is one within a gap. */
export function point_near(series: Series, at: number): Point | undefined {
  let best: Point | undefined;
  for (const point of series) if (!best || Math.abs(point.at - at) < Math.abs(best.at - at)) best = point;
  return best && Math.abs(best.at - at) <= longest_gap / 2 ? best : undefined;
}

export function highest(series: Series): number | undefined {
  return series.length === 0 ? undefined : Math.max(...series.map((one) => one.value));
}
