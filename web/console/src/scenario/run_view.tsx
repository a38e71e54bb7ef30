// A run: variables and history.
import { useLayoutEffect, useRef } from 'preact/hooks';

import { useConsole } from '../context';
import { clock_time, duration } from '../i18n/i18n';
import { Badge, error_text, Icon, type Tone } from '../ui';
import type { Desk, HistoryEntry, Run } from './desk';
import { shown_name } from './picture';
import { nodes_in, with_text } from './source';
import { Trouble } from './trouble';
import { listed } from './variables';
import * as texts from './texts';

const most_shown = 300;

/** The state of a run as tone and text. */
export function state_of(run: Run | undefined, is_running: boolean): { tone: Tone; text: string; why?: string } {
  if (!run) return { tone: 'calm', text: texts.never_run() };
  if (is_running) return { tone: 'busy', text: run.state === '' ? texts.binding() : texts.running() };
  const { outcome } = run;
  switch (outcome?.how) {
    case 'ended':
      return { tone: 'good', text: texts.ended(shown_name(outcome.state)) };
    case 'failed':
      return { tone: 'bad', text: texts.failed(shown_name(outcome.state)) };
    case 'trouble':
      return {
        tone: 'bad',
        text: texts.trouble(),
        why: outcome.trouble instanceof Trouble ? outcome.trouble.say() : error_text(outcome.trouble),
      };
    default:
      return { tone: 'calm', text: texts.was_stopped() };
  }
}

export function RunState({ desk }: { desk: Desk }) {
  const console = useConsole();
  void desk.pulse.beat.value;
  const { run } = desk;
  const { tone, text } = state_of(run, desk.is_running.value);
  const until = run?.ended_at ?? console.time();
  return (
    <span class="scenario-run-state">
      <Badge tone={tone}>{text}</Badge>
      {run && <span class="scenario-soft">{texts.for_so_long(duration(until - run.began_at))}</span>}
    </span>
  );
}

export function RunView({ desk }: { desk: Desk }) {
  void desk.pulse.beat.value;
  const { why } = state_of(desk.run, desk.is_running.value);
  return (
    <div class="scenario-run">
      {why !== undefined && <p class="scenario-why"><Icon name="warning" /> {why}</p>}
      <History desk={desk} />
      <VariablesTable desk={desk} />
    </div>
  );
}

function History({ desk }: { desk: Desk }) {
  const frame = useRef<HTMLDivElement>(null);
  const at_end = useRef(true);
  void desk.pulse.beat.value;
  const entries = desk.history.list().slice(-most_shown);
  const last = entries.at(-1)?.number;
  useLayoutEffect(() => {
    const element = frame.current;
    if (element && at_end.current) element.scrollTop = element.scrollHeight;
  }, [last]);
  const scrolled = () => {
    const { scrollTop, clientHeight, scrollHeight } = frame.current!;
    at_end.current = scrollTop + clientHeight >= scrollHeight - 30;
  };
  return (
    <section class="scenario-history">
      <h3>{texts.history()}</h3>
      <div class="scenario-history-frame" ref={frame} onScroll={scrolled} tabIndex={0} role="region" aria-label={texts.history()}>
        {entries.length === 0 && <p class="scenario-soft">{texts.no_history()}</p>}
        <ol>
          {entries.map((one) => <Entry key={one.number} entry={one} is_new={one.number === last && desk.is_running.value} />)}
        </ol>
      </div>
    </section>
  );
}

function Entry({ entry, is_new }: { entry: HistoryEntry; is_new: boolean }) {
  const time = <time class="scenario-time">{clock_time(entry.at, false)}</time>;
  if (entry.kind === 'print')
    return (
      <li class="scenario-print">
        {time}
        <Icon name="messages" />
        <span><span class="unseen">{texts.printed()}: </span><span class="scenario-printed">{entry.line}</span></span>
      </li>
    );
  return (
    <li class={is_new ? 'scenario-transition scenario-new' : 'scenario-transition'}>
      {time}
      <span>
        {shown_name(entry.from)}{' '}
        <span class="scenario-soft" aria-hidden="true">
          →
        </span>
        <span class="unseen">, </span> <strong>{shown_name(entry.to)}</strong>
        <span class="scenario-by" title={entry.by}>
          {entry.by}
        </span>
      </span>
    </li>
  );
}

// Initial values are changed in the text.
function VariablesTable({ desk }: { desk: Desk }) {
  void desk.pulse.beat.value;
  const { root, text } = desk.reading.value;
  const variables = root ? [...nodes_in(root)].filter((one) => one.name === 'variable' && one.parent === root) : [];
  const { run } = desk;
  return (
    <section class="scenario-variables">
      <h3>{texts.variables()} <span class="scenario-soft">{texts.begins_hint()}</span></h3>
      <div class="scenario-variables-frame">
        {variables.length === 0 ? (
          <p class="scenario-soft">{texts.no_variables()}</p>
        ) : (
          <table class="table">
            <thead>
              <tr>
                <th scope="col">{texts.column_name()}</th>
                <th scope="col">{texts.column_begins()}</th>
                <th scope="col">{texts.column_value()}</th>
              </tr>
            </thead>
            <tbody>
              {variables.map((node) => {
                const name = (node.element.attribute('name') ?? '').trim();
                const value = listed(run?.variables.get(name) ?? []);
                const changed = run?.changed.get(name);
                return (
                  <tr key={node.path}>
                    <th scope="row"><code>{name}</code></th>
                    <td>
                      <input
                        type="text"
                        aria-label={texts.begins_with(name)}
                        value={node.element.text.trim()}
                        disabled={desk.is_running.value}
                        onInput={(event) => desk.edit(with_text(text, node, event.currentTarget.value), `variable ${name}`)}
                      />
                    </td>
                    <td class="scenario-value">
                      {run && (
                        <span key={changed} class={changed === undefined ? undefined : 'scenario-changed'}>
                          {value === '' ? <span class="scenario-soft">{texts.nothing()}</span> : value}
                        </span>
                      )}
                    </td>
                  </tr>
                );
              })}
            </tbody>
          </table>
        )}
      </div>
    </section>
  );
}
