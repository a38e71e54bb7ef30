// The most important numbers.
import { useConsole } from '../context';
import { bytes_text, count_text, duration } from '../i18n/i18n';
import * as shell from '../shell/texts';
import { Badge, Fact, tone_of } from '../ui';
import { fresh_for, growth, latencies, type Series } from './series';
import * as texts from './texts';
import { ms_text } from './plots';

export function Figures() {
  const { link, metrics, traffic, now } = useConsole();
  const { phase, since, reason } = link.view.value;
  const scrape = metrics.latest.value;
  const from = now.value - fresh_for;
  const number = (name: string) => {
    const value = scrape?.value(name);
    return value === undefined ? texts.none() : count_text(value);
  };
  const last = (series: Series, text: (value: number) => string) => (series.length === 0 ? texts.none() : text(series.at(-1)!.value));
  const memory = scrape?.value('process_resident_memory_bytes');
  return (
    <>
      {metrics.trouble.value === '' && metrics.is_stale(now.value) && (
        <p class="health-trouble">{texts.stale(duration(now.value - scrape!.at))}</p>
      )}
      {metrics.trouble.value !== '' && <p class="health-trouble">{texts.metrics_trouble(metrics.trouble.value)}</p>}
      <dl class="health-figures">
        <Fact name={texts.link()}>
          <Badge tone={tone_of(phase)} title={reason}>{shell.phase(phase)}</Badge>
          <small>{texts.since(Math.max(0, now.value - since))}</small>
        </Fact>
        <Fact name={texts.latency()}>{last(latencies(traffic.seconds, from).middle, ms_text)}</Fact>
        <Fact name={texts.requests()}>
          {last(
            growth(metrics.history, from, (one) => one.value('rois_requests_total')),
            (n) => texts.a_second(Math.round(n)),
          )}
        </Fact>
        <Fact name={texts.sessions()}>{number('rois_sessions')}</Fact>
        <Fact name={texts.connections()}>{number('rois_connections')}</Fact>
        <Fact name={texts.components()}>{number('rois_components')}</Fact>
        <Fact name={texts.memory()}>{memory === undefined ? texts.none() : bytes_text(memory)}</Fact>
        <Fact name={texts.processor()}>
          {last(
            growth(metrics.history, from, (one) => one.value('process_cpu_seconds_total')),
            (n) => texts.share(Math.round(n * 100)),
          )}
        </Fact>
        <Fact name={texts.files()}>{number('process_open_fds')}</Fact>
      </dl>
    </>
  );
}
