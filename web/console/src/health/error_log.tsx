// The session's errors, each with its details.
import { useState } from 'preact/hooks';

import { useConsole } from '../context';
import { CommandProgress, DetailsOf, LoggedXml } from '../forms';
import { clock_time, duration } from '../i18n/i18n';
import * as shell from '../shell/texts';
import type { Phase } from '../state/session/link_state';
import { Badge, Button, type Tone, XmlView } from '../ui';
import { type LogEntry, log_of, reason_of, refused_component } from './log';
import * as texts from './texts';

const shown_at_first = 50;

export function ErrorLog() {
  const console = useConsole();
  const [most, set_most] = useState(shown_at_first);
  void console.events.pulse.beat.value;
  void console.commands.pulse.beat.value;
  void console.history.pulse.beat.value;
  void console.now.value; // for new refusals
  const entries = log_of(console);
  return (
    <section class="health-part health-log">
      <h3>{texts.log()}</h3>
      {entries.length === 0 && <p class="health-soft">{texts.no_log()}</p>}
      <ol class="plain-list">
        {entries.slice(0, most).map((entry) => (
          <li key={entry.key}>
            <Entry entry={entry} />
          </li>
        ))}
      </ol>
      {entries.length > most && (
        <Button small onClick={() => set_most(most + 200)}>
          {texts.older(entries.length - most)}
        </Button>
      )}
    </section>
  );
}

interface Description {
  tone: Tone;
  kind: string;
  title: string;
  component: string;
  more: string;
}

function description_of(entry: LogEntry): Description {
  switch (entry.kind) {
    case 'error': {
      const { error, details } = entry.entry;
      const shown = details.state === 'there' ? details.results.parameters.filter((one) => !/^(component_ref|time)$/.test(one.name)) : [];
      const more = shown.map((one) => one.values.join('; ')).join(' · ');
      return { tone: 'bad', kind: texts.error(), title: error.error_type, component: error.component_ref?.code ?? '', more };
    }
    case 'gap': {
      const { gap } = entry.entry;
      return {
        tone: 'warning',
        kind: texts.missed(),
        title: gap.reason === 'session' ? texts.gap_session() : texts.gap_lost(gap.count),
        component: '',
        more: '',
      };
    }
    case 'refused': {
      const { document } = entry;
      const title = [document.request?.name, document.return_code ?? document.name].filter(Boolean).join(': ');
      return { tone: 'warning', kind: texts.refused(), title, component: refused_component(document), more: reason_of(document) };
    }
    case 'command': {
      const { state, command_type, component, results } = entry.command;
      return { tone: 'bad', kind: texts.command(), title: `${command_type}: ${state}`, component, more: results?.text('reason') ?? '' };
    }
    case 'link': {
      const { value, from, to, note } = entry.span;
      return { tone: 'bad', kind: texts.link(), title: shell.phase(value as Phase), component: duration(to - from), more: note };
    }
  }
}

function Entry({ entry }: { entry: LogEntry }) {
  const { tone, kind, title, component, more } = description_of(entry);
  const [is_open, set_open] = useState(false);
  const at = clock_time(entry.at); // distinguishes open entries
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
  const document = entry.kind === 'refused' ? entry.document : entry.kind === 'command' ? entry.command.completed : entry.entry.document;
  return (
    <details onToggle={(event) => set_open(event.currentTarget.open)}>
      <summary class="health-entry">{summary}</summary>
      {is_open && (
        <div class="health-opened">
          {entry.kind === 'error' && (
            <DetailsOf details={entry.entry.details} label={`${texts.details()}: ${at}`} none={texts.no_details()} />
          )}
          {entry.kind === 'refused' && entry.document.request?.text && (
            <>
              <h4>{texts.request()}</h4>
              <XmlView text={entry.document.request.text} label={`${texts.request()}, ${at}`} />
            </>
          )}
          {entry.kind === 'command' && <CommandProgress entry={entry.command} />}
          {document !== undefined && (
            <>
              <h4>{texts.document()}</h4>
              <LoggedXml label={`${texts.document()}, ${at}`} document={document} />
            </>
          )}
        </div>
      )}
    </details>
  );
}
