// The gateway's metrics (/metrics, Prometheus text format) of the last minutes.
import { computed, signal } from '@preact/signals';
import { answer_text } from 'rois-client';

import type { Environment } from '../base/environment';
import { Poll } from '../base/poll';
import { reason_of } from '../base/reason_of';
import { Ring } from '../base/ring';

/** One line of /metrics. */
export interface Sample {
  name: string;
  labels: Readonly<Record<string, string>>;
  value: number;
}

/** One response of /metrics. */
export class Scrape {
  private readonly by_name = new Map<string, Sample[]>();

  constructor(
    readonly at: number, // ms since 1970
    samples: Sample[] = [],
  ) {
    for (const sample of samples) {
      const earlier = this.by_name.get(sample.name);
      if (earlier) earlier.push(sample);
      else this.by_name.set(sample.name, [sample]);
    }
  }

  all(name: string): readonly Sample[] {
    return this.by_name.get(name) ?? [];
  }

  /** The sum of the samples with these labels; undefined if there are none. */
  value(name: string, labels: Record<string, string> = {}): number | undefined {
    const samples = this.all(name).filter((one) => Object.entries(labels).every(([key, text]) => one.labels[key] === text));
    return samples.length === 0 ? undefined : samples.reduce((sum, one) => sum + one.value, 0);
  }
}

export class MetricsState {
  /** The latest response; undefined if not available. */
  readonly latest = signal<Scrape | undefined>(undefined);
  /** Why `latest` is undefined. */
  readonly trouble = signal('');
  /** The last two minutes, oldest first. Read `latest.value` to be updated. */
  readonly history = new Ring<Scrape>(120);
  /** Bound components by ref, with the session's number. */
  readonly bound = computed<ReadonlyMap<string, string>>(
    () =>
      new Map(
        (this.latest.value?.all('rois_component_bound') ?? [])
          .filter((one) => one.value > 0)
          .map((one) => [one.labels['component_ref'] ?? '', one.labels['session'] ?? '']),
      ),
  );
  readonly poll: Poll;

  /** Whether the latest response is too old to rely on. */
  is_stale(now: number): boolean {
    return now - (this.latest.value?.at ?? now) > stale_after;
  }

  constructor(
    private readonly environment: Environment,
    private readonly token: () => string | undefined,
    may_ask: () => boolean,
    period = 1000, // ms
  ) {
    this.poll = new Poll(environment, period, () => this.read(), may_ask);
  }

  private async read(): Promise<void> {
    const token = this.token();
    const headers: HeadersInit = token === undefined ? {} : { Authorization: `Bearer ${token}` };
    try {
      const answer = await this.environment.fetch('/metrics', { headers, cache: 'no-store' });
      if (!answer.ok) throw new Error(`status ${answer.status}`);
      const scrape = new Scrape(this.environment.now(), read_metrics(await answer_text(answer)));
      this.history.push(scrape);
      this.latest.value = scrape;
      this.trouble.value = '';
    } catch (error) {
      this.trouble.value = reason_of(error);
    }
  }
}

const stale_after = 5000; // ms

const line = /^([A-Za-z_:][\w:]*)(?:\{(.*)\})?\s+(\S+)(?:\s+\d+)?$/;
const label = /([A-Za-z_]\w*)="((?:[^"\\]|\\.)*)"/g;

/** Parses Prometheus text format; ignores invalid lines. */
export function read_metrics(text: string): Sample[] {
  const samples: Sample[] = [];
  for (const one of text.split('\n')) {
    const found = one.startsWith('#') ? null : line.exec(one.trim());
    if (!found) continue;
    const labels: Record<string, string> = {};
    for (const [, name, value] of (found[2] ?? '').matchAll(label))
      labels[name!] = value!.replace(/\\(.)/g, (_, c: string) => (c === 'n' ? '\n' : c));
    samples.push({ name: found[1]!, labels, value: number_of(found[3]!) });
  }
  return samples;
}

function number_of(text: string): number {
  if (/^[+-]?Inf$/i.test(text)) return text.startsWith('-') ? -Infinity : Infinity;
  return Number(text);
}
