// The selected document: its relations, details and text.
import { useState } from 'preact/hooks';
import { is_notification, notification_of, parse_xml, Results, results_of } from 'rois-client';

import { useConsole } from '../context';
import { CommandProgress, ResultsTable } from '../forms';
import { clock_time } from '../i18n/i18n';
import { show_component } from '../shell/navigation';
import type { Console } from '../state/console';
import type { LoggedDocument } from '../state/session/document_log';
import type { Details } from '../state/session/events_state';
import { Badge, Button, Checkbox, CurlButton, StatusBadge, XmlView } from '../ui';
import type { ShownRecording } from './shown';
import { command_of, component_of, expire_of } from './summary';
import * as texts from './texts';

export interface ReaderProps {
  document: LoggedDocument;
  tape: ShownRecording | undefined;
  choose: (document: LoggedDocument) => void;
}

export function Reader({ document, tape, choose }: ReaderProps) {
  const console = useConsole();
  const [raw, set_raw] = useState(false);
  const { name, return_code, direction } = document;
  const component = component_of(document);
  const place = place_of(document);
  const answer = document.kind === 'request' ? answer_to(console, tape, document) : undefined;
  return (
    <div class="messages-reader">
      <div class="messages-head">
        <h3>{name === '' ? '—' : name}</h3>
        {return_code !== undefined && <StatusBadge status={return_code} />}
        {tape && <Badge tone="warning">{texts.not_live()}</Badge>}
        <span class="soft">
          {direction === 'out' ? texts.outward() : texts.inward()} {texts.at(document.at)} · {texts.size(document.text.length)}
          {document.took !== undefined && ` · ${texts.took(document.took)}`}
        </span>
      </div>
      <div class="messages-head">
        {document.request && <Button small icon="up" onClick={() => choose(document.request!)}>{texts.to_request()}</Button>}
        {answer && <Button small icon="down" onClick={() => choose(answer)}>{texts.to_answer()}</Button>}
        {component !== '' && !tape && console.profile.component(component) && (
          <Button small icon="components" onClick={() => show_component(console, component)}>{texts.to_component(component)}</Button>
        )}
        {direction === 'out' && !tape && <CurlButton request={document.text} />}
        <Checkbox label={texts.raw()} checked={raw} change={set_raw} />
      </div>
      {tape ? <Values results={values_in(document)} /> : <Live document={document} />}
      {place && <p class="soft">{texts.place(place.line, place.column)}</p>}
      <XmlView text={document.text} raw={raw} label={texts.document(name)} />
      {place && document.request && <XmlView text={document.request.text} raw label={texts.to_request()} marked_line={place.line} />}
    </div>
  );
}

// Details that the engine can still provide.
function Live({ document }: { document: LoggedDocument }) {
  const console = useConsole();
  const { events, commands } = console;
  if (document.name === 'completed') {
    const entry = commands.find(command_of(document));
    return entry ? <CommandProgress entry={entry} /> : null;
  }
  if (document.name === 'receive_event') {
    void events.pulse.beat.value;
    const entry = (document.is_own ? events.own_events : events.events).find(document.number, (one) => one.document);
    return entry ? (
      <DetailsOf details={entry.details} expire={expire_of(document)} ask={() => void events.fetch_event(entry)} />
    ) : (
      <p class="soft">{texts.not_kept()}</p>
    );
  }
  if (document.name === 'receive_error') {
    void events.pulse.beat.value;
    const entry = events.errors.find(document.number, (one) => one.document);
    return entry ? <DetailsOf details={entry.details} expire={undefined} ask={() => void events.fetch_error(entry)} /> : null;
  }
  return <Values results={values_in(document)} />;
}

function DetailsOf({ details, expire, ask }: { details: Details; expire: number | undefined; ask: () => void }) {
  const { now, link } = useConsole();
  const is_expired = expire !== undefined && expire <= now.value;
  const until =
    expire === undefined ? null : is_expired ? (
      <Badge>{texts.expired()}</Badge>
    ) : (
      <span class="soft">{texts.expires(clock_time(expire, false))}</span>
    );
  switch (details.state) {
    case 'there':
      return (
        <>
          {until}
          <Values results={details.results} />
        </>
      );
    case 'gone':
      return <p>{texts.gone()} <span class="soft">{details.reason}</span> {until}</p>;
    case 'asked':
      return <p class="soft" role="status">{texts.fetching()}</p>;
    default:
      return (
        <p class="messages-head">
          <Button small icon="download" disabled={!link.is_open} onClick={ask}>{texts.fetch()}</Button> {until}
        </p>
      );
  }
}

function Values({ results }: { results: Results }) {
  return results.parameters.length === 0 ? null : <ResultsTable label={texts.details()} results={results} />;
}

function values_in(document: LoggedDocument): Results {
  if (document.direction === 'out' || !document.text.includes('result')) return new Results();
  try {
    const element = parse_xml(document.text);
    if (!is_notification(element)) return results_of(element);
    const notification = notification_of(element);
    return notification.name === 'receive_event' ? notification.results : new Results();
  } catch {
    return new Results(); // a recording may have any content
  }
}

// The place in the request that a fault names.
function place_of({ kind, text }: LoggedDocument): { line: number; column: number } | undefined {
  const found = kind === 'fault' ? /^[^>]*?\sline="(\d+)"/.exec(text.slice(text.indexOf('<fault'))) : null;
  const column = /^[^>]*?\scolumn="(\d+)"/.exec(text.slice(text.indexOf('<fault')))?.[1];
  return found ? { line: Number(found[1]), column: Number(column ?? 1) } : undefined;
}

const most_later = 500; // documents searched after a request for its answer

function answer_to({ documents }: Console, tape: ShownRecording | undefined, request: LoggedDocument): LoggedDocument | undefined {
  for (let i = request.number + 1; i <= request.number + most_later; ++i) {
    const one = tape ? tape.documents[i] : documents.ring.numbered(i);
    if (one?.request === request) return one;
  }
  return undefined;
}
