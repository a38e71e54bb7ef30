// A request being written, the button that sends it, and its outcome.
import './forms.css';

import type { ComponentChildren } from 'preact';
import { useEffect, useRef, useState } from 'preact/hooks';
import { parse_xml, type Operation, Results, results_of, RoisError } from 'rois-client';

import { useConsole } from '../context';
import { duration } from '../i18n/i18n';
import type { Console } from '../state/console';
import type { CommandEntry } from '../state/session/commands_state';
import type { LoggedDocument } from '../state/session/document_log';
import { Button, CurlButton, error_text, type IconName, StatusBadge, XmlView } from '../ui';
import { CommandProgress } from './command_progress';
import { draft, useDraft } from './drafts';
import * as texts from './exchange_texts';
import { ResultsTable } from './results_table';

export interface ExchangeProps {
  /** Name for buttons and regions: `navigation start`. */
  title: string;
  operation: Operation;
  /** The document that would be sent; empty if it cannot be written. */
  request: string;
  /** Sends the request. */
  act: () => Promise<unknown>;
  /** Called before sending; false prevents it. */
  may_send?: () => boolean;
  /** Whether the button is enabled. */
  can_send?: boolean;
  /** Enter in a field sends the request. */
  by_enter?: boolean;
  label?: string;
  icon?: IconName;
  /** Additional buttons. */
  children?: ComponentChildren;
}

export interface Outcome {
  request: LoggedDocument | undefined; // as sent; undefined if it was not sent
  answer: LoggedDocument | undefined;
  error: unknown;
}

export function Exchange({
  title,
  operation,
  request,
  act,
  may_send,
  can_send = true,
  by_enter = false,
  label,
  icon,
  children,
}: ExchangeProps) {
  const console = useConsole();
  const [outcome, set_outcome] = useDraft<Outcome | undefined>(key_of(title), undefined);
  const [is_busy, set_busy] = useState(false);
  const frame = useRef<HTMLDivElement>(null);
  const sent = useRef<string>();
  const send = async () => {
    if (may_send && !may_send()) {
      const form = frame.current?.closest('form') ?? frame.current?.parentElement;
      requestAnimationFrame(() => form?.querySelector<HTMLElement>('[aria-invalid="true"]')?.focus());
      return;
    }
    sent.current = request;
    set_busy(true);
    set_outcome(await watched(console, operation, act));
    set_busy(false);
  };
  return (
    <div class="exchange" ref={frame}>
      <div class="exchange-parts">
        <div class="exchange-buttons">
          <Button
            type={by_enter ? 'submit' : 'button'}
            look="primary"
            icon={icon ?? 'play'}
            busy={is_busy}
            disabled={!can_send || !console.link.is_open}
            onClick={() => void send()}
          >
            {label ?? texts.send()}
          </Button>
          {children}
          <CurlButton request={request} disabled={request === ''} class="exchange-curl" />
        </div>
        <div class="exchange-came" aria-live="polite">
          {outcome ? <Came title={title} follows={sent.current === request} {...outcome} /> : <p class="exchange-none">{texts.none()}</p>}
        </div>
        {request !== '' && <div class="exchange-request"><XmlView text={request} label={texts.request(title)} /></div>}
      </div>
    </div>
  );
}

const key_of = (title: string) => `outcome of ${title}`;

/** The outcome of the last request with this title. */
export function last_outcome(title: string): Outcome | undefined {
  return draft(key_of(title));
}

/** Runs `act` and finds its request and answer. */
export async function watched(console: Console, operation: Operation, act: () => Promise<unknown>): Promise<Outcome> {
  const outcome: Outcome = { request: undefined, answer: undefined, error: undefined };
  const stop = console.documents.listen((one) => {
    if (one.direction === 'out' && one.name === operation && !one.is_own) outcome.request = one;
    if (one.request !== undefined && one.request === outcome.request) outcome.answer = one;
  });
  try {
    await act();
  } catch (error) {
    outcome.error = error;
  } finally {
    stop();
  }
  return outcome;
}

// Shows the state of the commands, or the refusal, first. If `follows`, scrolls it into view whenever it grows.
function Came({ title, answer, error, follows }: Outcome & { title: string; follows: boolean }) {
  const { commands } = useConsole();
  void commands.pulse.beat.value;
  const sent = answer ? commands.all.list().filter((one) => one.sequence.document === answer.request?.number) : [];
  const results = answer && answer.return_code === 'OK' ? results_in(answer) : new Results();
  const refused = error instanceof RoisError && error.failure === 'refused' && answer !== undefined;
  const frame = useRef<HTMLDivElement>(null);
  const height = useRef(0);
  useEffect(() => {
    const now = frame.current!.offsetHeight;
    if (follows && now !== height.current) frame.current!.scrollIntoView({ block: 'nearest' });
    height.current = now;
  });
  return (
    <>
      <div class="exchange-said" ref={frame}>
        {sent.map((one: CommandEntry) => <CommandProgress key={one.id} entry={one} />)}
        {(sent.length === 0 || error !== undefined) && (
          <p class="exchange-line">
            <StatusBadge status={answer ? (answer.return_code ?? answer.name) : 'ERROR'} />
            {error !== undefined && <span class="exchange-why">{refused ? reason_in(answer) : error_text(error)}</span>}
          </p>
        )}
      </div>
      {answer?.took !== undefined && <p class="soft">{texts.took(duration(answer.took))}</p>}
      {results.parameters.length > 0 && <ResultsTable label={texts.results(title)} results={results} />}
      {answer && <XmlView text={answer.text} label={texts.answer(title)} />}
    </>
  );
}

function results_in({ text }: LoggedDocument): Results {
  return results_of(parse_xml(text));
}

function reason_in({ text }: LoggedDocument): string {
  return parse_xml(text).text_of('reason');
}
