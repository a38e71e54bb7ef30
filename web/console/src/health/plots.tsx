import { useSignal } from '@preact/signals';

import { useConsole } from '../context';
import { count_text, language } from '../i18n/i18n';
import type { Scrape } from '../state/engine/metrics_state';
import type { LoggedDocument } from '../state/session/document_log';
import type { Second } from '../state/session/traffic';
import { Plot } from './plot';
import { documents_a_second, growth, inside, latencies, shown_for } from './series';
import * as texts from './texts';

/** Rounded to significant digits. */
export function ms_text(ms: number): string {
  return texts.ms(Number(digits(ms)));
}

function digits(value: number): string {
  return value.toLocaleString('en', { maximumSignificantDigits: value < 100 ? 2 : 3, useGrouping: false });
}

export function Plots() {
  const { traffic, metrics, now: clock } = useConsole();
  const cursor = useSignal<number | undefined>(undefined);
  void language.value;
  const now = clock.value;
  const from = now - shown_for;
  const { middle, slowest } = latencies(traffic.seconds, from);
  const counted = (name: string) => growth(metrics.history, from, (one: Scrape) => one.value(name));
  const own = (count: (one: Second) => number) => documents_a_second(traffic.seconds, from, now, count);
  const rate = { text: (n: number) => texts.a_second(Number(digits(n))), short: count_text };
  const worst = worst_of([...traffic.seconds].filter((one) => one.at >= from));
  return (
    <section class="health-plots" aria-label={texts.plots()}>
      <h3>{texts.plots()}</h3>
      <div class="health-grid">
        <div>
          <Plot
            title={texts.latency_plot()}
            now={now}
            cursor={cursor}
            text={ms_text}
            short={digits}
            lines={[
              { name: texts.middle(), ink: 'first', series: middle },
              { name: texts.slowest(), ink: 'second', series: slowest },
              { name: texts.inside(), ink: 'third', series: inside(metrics.history, from) },
            ]}
          />
          {worst && <p class="health-note">{texts.slowest_was(asked(worst), ms_text(worst.took ?? 0))}</p>}
        </div>
        <Plot
          title={texts.gateway_plot()}
          now={now}
          cursor={cursor}
          {...rate}
          lines={[
            { name: texts.requests(), ink: 'first', series: counted('rois_requests_total') },
            { name: texts.notifications(), ink: 'second', series: counted('rois_notifications_delivered_total') },
            { name: texts.fired(), ink: 'third', series: counted('rois_events_total') },
          ]}
        />
        <Plot
          title={texts.own_plot()}
          now={now}
          cursor={cursor}
          {...rate}
          lines={[
            { name: texts.sent(), ink: 'first', series: own((one) => one.sent) },
            { name: texts.received(), ink: 'second', series: own((one) => one.received) },
          ]}
        />
      </div>
    </section>
  );
}

// `search` asks the engine, not the component in its condition.
function asked({ name, component, request }: LoggedDocument): string {
  const operation = request?.name ?? name;
  return operation === 'search' || component === undefined ? operation : `${operation} ${component}`;
}

function worst_of(seconds: readonly Second[]) {
  let worst: Second['slowest'];
  for (const { slowest } of seconds) if ((slowest?.took ?? 0) > (worst?.took ?? 0)) worst = slowest;
  return worst;
}
