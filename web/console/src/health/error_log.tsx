// What this session was told of that went wrong; each opens to what is known of it.
import { useState } from 'preact/hooks';

import { CommandProgress, ResultsTable } from '../forms';
import { clock_time, duration } from '../i18n/i18n';
import { useConsole } from '../shell/context';
import { show_panel } from '../shell/layout';
import { texts as shell } from '../shell/texts';
import type { Details } from '../state/events_state';
import type { Phase } from '../state/link_state';
import { Badge, Button, type Tone, XmlView } from '../ui';
import { type LogEntry, log_of, reason_of, refused_component } from './log';
import { texts } from './texts';

const shown_at_first = 50;

export function ErrorLog() {
  const console = useConsole();
  const t = texts();
  const [most, set_most] = useState(shown_at_first);
  void console.events.pulse.beat.value;
  void console.commands.pulse.beat.value;
  void console.history.pulse.beat.value;
  void console.now.value; // what was refused
  const entries = log_of(console);
  return (
    <section class="health-part health-log">
      <h3>{t.log}</h3>
      {entries.length === 0 && <p class="health-soft">{t.no_log}</p>}
      <ol class="plain-list">
        {entries.slice(0, most).map((entry) => (
          <li key={entry.key}>
            <Entry entry={entry} />
          </li>
        ))}
      </ol>
      {entries.length > most && (
        <Button small onClick={() => set_most(most + 200)}>
          {t.older(entries.length - most)}
        </Button>
      )}
    </section>
  );
}

interface Told {
  tone: Tone;
  kind: string;
  title: string;
  component: string;
  more: string;
}

function told(entry: LogEntry): Told {
  const t = texts();
  switch (entry.kind) {
    case 'error': {
      const { error, details } = entry.entry;
      const said = details.state === 'there' ? details.results.parameters.filter((one) => !/^(component_ref|time)$/.test(one.name)) : [];
      const more = said.map((one) => one.values.join('; ')).join(' · ');
      return { tone: 'bad', kind: t.error, title: error.error_type, component: error.component_ref?.code ?? '', more };
    }
    case 'gap': {
      const { gap } = entry.entry;
      return { tone: 'warning', kind: t.missed, title: gap.reason === 'session' ? t.gap_session : t.gap_lost(gap.count), component: '', more: '' };
    }
    case 'refused': {
      const { document } = entry;
      const title = [document.request?.name, document.return_code ?? document.name].filter(Boolean).join(': ');
      return { tone: 'warning', kind: t.refused, title, component: refused_component(document), more: reason_of(document) };
    }
    case 'command': {
      const { state, command_type, component, results } = entry.command;
      return { tone: 'bad', kind: t.command, title: `${command_type}: ${state}`, component, more: results?.text('reason') ?? '' };
    }
    case 'link': {
      const { value, from, to, note } = entry.span;
      return { tone: 'bad', kind: t.link, title: shell().phase(value as Phase), component: duration(to - from), more: note };
    }
  }
}

function Entry({ entry }: { entry: LogEntry }) {
  const { tone, kind, title, component, more } = told(entry);
  const [is_open, set_open] = useState(false);
  const at = clock_time(entry.at);
  const summary = (
    <>
      <span class="health-when">{at}</span>
      <Badge tone={tone}>{kind}</Badge>
      <strong>{title}</strong>
      {component !== '' && <span>{component}</span>}
      <span class="health-more">{more}</span>
    </>
  );
  if (entry.kind === 'gap' || entry.kind === 'link') return <div class="health-entry">{summary}</div>;
  return (
    <details onToggle={(event) => set_open(event.currentTarget.open)}>
      <summary class="health-entry">{summary}</summary>
      {is_open && (
        <div class="health-opened">
          {entry.kind === 'error' && <Known title={at} details={entry.entry.details} />}
          {entry.kind === 'refused' && entry.document.request && <LoggedText title={texts().request} at={at} text={entry.document.request.text} />}
          {entry.kind === 'refused' && <LoggedText title={texts().document} at={at} text={entry.document.text} number={entry.document.number} />}
          {entry.kind === 'command' && <CommandProgress entry={entry.command} />}
          {entry.kind === 'command' && entry.command.completed !== undefined && <Remembered at={at} number={entry.command.completed} />}
          {entry.kind === 'error' && <Remembered at={at} number={entry.entry.document} />}
        </div>
      )}
    </details>
  );
}

function Known({ title, details }: { title: string; details: Details }) {
  const t = texts();
  if (details.state === 'gone') return <p>{t.gone(details.reason)}</p>;
  if (details.state !== 'there') return <p>{t.asked}</p>;
  if (details.results.parameters.length === 0) return <p>{t.no_details}</p>;
  return <ResultsTable label={`${t.details}: ${title}`} results={details.results} />;
}

function Remembered({ at, number }: { at: string; number: number }) {
  const { documents } = useConsole();
  const document = documents.ring.numbered(number);
  return document ? <LoggedText title={texts().document} at={at} text={document.text} number={number} /> : <p>{texts().document_gone}</p>;
}

// `at` tells apart those that are open at once.
function LoggedText({ title, at, text, number }: { title: string; at: string; text: string; number?: number }) {
  const { selection } = useConsole();
  const show = () => {
    selection.document.value = number;
    show_panel('messages');
  };
  return (
    <>
      <h4>{title}</h4>
      <XmlView text={text} label={`${title}, ${at}`} />
      {number !== undefined && <Button small look="quiet" icon="messages" onClick={show}>{texts().in_messages}</Button>}
    </>
  );
}
