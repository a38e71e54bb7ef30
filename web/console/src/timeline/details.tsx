// Details of the selected thing, beside the lanes.
import { useEffect, useRef } from 'preact/hooks';
import { Results } from 'rois-client';

import { useConsole } from '../context';
import { CommandProgress, DetailsOf, LoggedXml, ResultsTable } from '../forms';
import { clock_time } from '../i18n/i18n';
import { show_component } from '../shell/navigation';
import type { CommandEntry } from '../state/session/commands_state';
import { Button, Fact, IconButton, StatusBadge } from '../ui';
import { describe, of_mark } from './describe';
import * as texts from './texts';
import { key_of, type Mark, mark_key, type Thing } from './things';
import type { TimeView } from './view';

export interface DetailsProps {
  view: TimeView;
  thing: Thing;
  open: (thing: Thing) => void;
  close: () => void;
}

const most_listed = 200;

export function DetailsPane({ view, thing, open, close }: DetailsProps) {
  const console = useConsole();
  const heading = useRef<HTMLHeadingElement>(null);
  const key = key_of(thing);
  useEffect(() => heading.current?.focus(), [key]);
  void console.events.pulse.beat.value; // details arrive, commands end
  void console.commands.pulse.beat.value;
  if (thing.kind === 'span') void console.now.value;
  const { kind, title, component, state, facts } = describe(thing, view.sources.at);
  const closed = (event: KeyboardEvent) => {
    if (event.key !== 'Escape') return;
    event.stopPropagation();
    close();
  };
  return (
    <section class="timeline-details" aria-label={texts.details()} onKeyDown={closed}>
      <header class="timeline-details-head">
        <h3 ref={heading} tabIndex={-1}>
          {kind !== '' && <span class="timeline-kind">{kind}</span>} {title}
        </h3>
        <IconButton icon="close" small label={texts.close()} onClick={close} />
      </header>
      <div class="timeline-details-body" tabIndex={0} role="region" aria-label={title}>
        <dl class="timeline-facts">
          {component !== '' && (
            <Fact name={texts.component()}>
              <button type="button" class="timeline-link" onClick={() => show_component(console, component)}>{component}</button>
            </Fact>
          )}
          {state !== '' && thing.kind !== 'command' && (
            <Fact name={texts.state()}><StatusBadge status={state} /></Fact>
          )}
          {facts.map(([name, value]) => <Fact key={name} name={name}>{value}</Fact>)}
          {thing.kind === 'command' && thing.entry.sequence.commands.length > 1 && <Fact name={texts.place()}>{thing.entry.path}</Fact>}
          {single(thing)?.kind === 'event' && <Expiry mark={single(thing)!} />}
        </dl>
        {thing.kind === 'command' && <CommandDetails entry={thing.entry} />}
        {thing.kind === 'marks' && thing.marks.length > 1 && <Many marks={thing.marks} view={view} open={open} />}
        {thing.kind === 'marks' && thing.marks.length === 1 && <MarkDetails mark={thing.marks[0]!} />}
      </div>
    </section>
  );
}

function single(thing: Thing): Mark | undefined {
  return thing.kind === 'marks' && thing.marks.length === 1 ? thing.marks[0] : undefined;
}

function Expiry({ mark }: { mark: Mark }) {
  return mark.kind === 'event' ? <Fact name={texts.expires()}>{clock_time(mark.entry.event.expire.getTime(), false)}</Fact> : null;
}

function CommandDetails({ entry }: { entry: CommandEntry }) {
  const { commands } = useConsole();
  useEffect(() => {
    if (entry.ended_at !== undefined && entry.state !== 'unknown') void commands.fetch_results(entry);
  }, [entry, entry.ended_at]);
  return (
    <>
      <CommandProgress entry={entry} />
      {entry.arguments.length > 0 && (
        <>
          <h4>{texts.arguments_of()}</h4>
          <ResultsTable label={texts.arguments_of()} results={new Results(entry.arguments)} />
        </>
      )}
      {entry.results && (
        <>
          <h4>{texts.results()}</h4>
          {entry.results.parameters.length === 0 ? (
            <p>{texts.no_results()}</p>
          ) : (
            <ResultsTable label={texts.results()} results={entry.results} />
          )}
        </>
      )}
      <LoggedText title={texts.request()} number={entry.sequence.document} />
    </>
  );
}

function MarkDetails({ mark }: { mark: Mark }) {
  const { events } = useConsole();
  useEffect(() => {
    if (mark.kind === 'event' && !events.is_expired(mark.entry)) void events.fetch_event(mark.entry);
    if (mark.kind === 'error') void events.fetch_error(mark.entry);
  }, [mark_key(mark)]);
  if (mark.kind === 'gap' || mark.kind === 'failed') return null;
  if (mark.kind === 'switched') return <LoggedText title={texts.document()} number={mark.entry.document} />;
  if (mark.kind === 'refused')
    return (
      <>
        {mark.entry.request && <LoggedText title={texts.request()} number={mark.entry.request.number} />}
        <LoggedText title={texts.document()} number={mark.entry.number} />
      </>
    );
  const is_expired = mark.kind === 'event' && mark.entry.details.state === 'none' && events.is_expired(mark.entry);
  return (
    <>
      <h4>{texts.results()}</h4>
      {is_expired ? <p>{texts.expired()}</p> : <DetailsOf details={mark.entry.details} label={texts.results()} none={texts.no_results()} />}
      <LoggedText title={texts.document()} number={mark.entry.document} />
    </>
  );
}

function LoggedText({ title, number }: { title: string; number: number }) {
  return (
    <details class="timeline-document">
      <summary>{title}</summary>
      <LoggedXml label={title} document={number} />
    </details>
  );
}

function Many({ marks, view, open }: { marks: readonly Mark[]; view: TimeView; open: (thing: Thing) => void }) {
  const [from, to] = [marks[0]!.entry.at, marks.at(-1)!.entry.at];
  const around = Math.max(20, (to - from) * 0.2);
  return (
    <>
      <p>
        <Button small icon="search" onClick={() => view.show(from - around, to + around)}>
          {texts.zoom_here()}
        </Button>
      </p>
      {marks.length > most_listed && <p>{texts.shown_of(most_listed, marks.length)}</p>}
      <ul class="plain-list timeline-many">
        {marks.slice(-most_listed).map((mark) => {
          const { kind, title, component } = of_mark(mark);
          return (
            <li key={mark_key(mark)}>
              <button type="button" onClick={() => open({ kind: 'marks', marks: [mark] })}>
                <span class="timeline-many-time">{clock_time(mark.entry.at)}</span>
                <span class="unseen">{kind}</span>
                <span class={mark.kind === 'event' || mark.kind === 'switched' ? undefined : 'timeline-bad'}>{title}</span>
                <span class="timeline-many-ref">{component}</span>
              </button>
            </li>
          );
        })}
      </ul>
    </>
  );
}
