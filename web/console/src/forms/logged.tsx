// A logged document, and the details of an event or error.
import { useConsole } from '../context';
import { show_document } from '../shell/navigation';
import type { LoggedDocument } from '../state/session/document_log';
import type { Details } from '../state/session/events_state';
import { Button, XmlView } from '../ui';
import * as texts from './exchange_texts';
import { ResultsTable } from './results_table';

/** The document, or the stored one with this number. */
export function LoggedXml({ label, document }: { label: string; document: LoggedDocument | number }) {
  const console = useConsole();
  // Numbers below 0 are from before a reload.
  const logged = typeof document === 'number' ? console.documents.ring.numbered(document) : document.number < 0 ? undefined : document;
  if (!logged) return <p>{texts.document_gone()}</p>;
  return (
    <>
      <XmlView text={logged.text} label={label} />
      <Button small look="quiet" icon="messages" onClick={() => show_document(console, logged.number)}>{texts.in_messages()}</Button>
    </>
  );
}

/** `none` is shown if there are no details. */
export function DetailsOf({ label, details, none }: { label: string; details: Details; none: string }) {
  if (details.state === 'gone') return <p>{texts.gone(details.reason)}</p>;
  if (details.state !== 'there') return <p role="status">{texts.fetching()}</p>;
  return details.results.parameters.length === 0 ? <p>{none}</p> : <ResultsTable label={label} results={details.results} />;
}
