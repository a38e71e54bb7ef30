// A logged document, and the details of an event or error.
import { useConsole } from '../context';
import { show_document } from '../shell/navigation';
import type { LoggedDocument } from '../state/session/document_log';
import type { Details } from '../state/session/events_state';
import { Button, XmlView } from '../ui';
import * as t from './exchange_texts';
import { ResultsTable } from './results_table';

/** The document, or the stored one with this number. */
export function LoggedXml({ label, document }: { label: string; document: LoggedDocument | number }) {
  const console = useConsole();
  const logged = typeof document === 'number' ? console.documents.ring.numbered(document) : document.number < 0 ? undefined : document; // below 0: from before a reload
  if (!logged) return <p>{t.document_gone()}</p>;
  return (
    <>
      <XmlView text={logged.text} label={label} />
      <Button small look="quiet" icon="messages" onClick={() => show_document(console, logged.number)}>{t.in_messages()}</Button>
    </>
  );
}

/** `none` is shown if there are no details. */
export function DetailsOf({ label, details, none }: { label: string; details: Details; none: string }) {
  if (details.state === 'gone') return <p>{t.gone(details.reason)}</p>;
  if (details.state !== 'there') return <p role="status">{t.fetching()}</p>;
  return details.results.parameters.length === 0 ? <p>{none}</p> : <ResultsTable label={label} results={details.results} />;
}
