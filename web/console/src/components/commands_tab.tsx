// The Commands tab: a form for each command of a component.
import { useState } from 'preact/hooks';
import { command, request, sequence_xml } from 'rois-client';

import { useConsole } from '../context';
import {
  arguments_in,
  ArgumentFields,
  asked_by,
  CommandProgress,
  Exchange,
  type Inputs,
  last_outcome,
  misplaced,
  problems_in,
  useDraft,
} from '../forms';
import { duration } from '../i18n/i18n';
import type { ComponentView } from '../state/engine/profile_state';
import { Checkbox, Form } from '../ui';
import { Pick } from './pick';
import * as texts from './texts';

// Types whose work is finished when `start` completes. Releasing a component of another type would stop its work.
const ending = /^(SpeechSynthesis|Reaction|Navigation|Move|Follow)$/;

export function CommandsTab({ view }: { view: ComponentView }) {
  const names = in_order(view.commands.map((one) => one.name));
  const [name, choose] = useDraft(`${view.ref} command`, names[0] ?? '');
  if (!names.includes(name)) return <p>{texts.no_commands()}</p>;
  return (
    <>
      <Pick label={texts.choose_command()} names={names} offered={view.commands} chosen={name} choose={choose} />
      <CommandForm key={name} view={view} name={name} />
    </>
  );
}

// `start` first, as the most used command.
function in_order(names: string[]): string[] {
  const rank = (name: string) => ['start', 'stop', 'suspend', 'resume'].indexOf(name);
  const common = names.filter((name) => rank(name) >= 0).sort((a, b) => rank(a) - rank(b));
  const own = names.filter((name) => rank(name) < 0);
  return [...own, ...common];
}

function CommandForm({ view, name }: { view: ComponentView; name: string }) {
  const console = useConsole();
  const [inputs, change] = useDraft<Inputs>(`${view.ref} ${name}`, {});
  const [give_back, set_give_back] = useDraft(`${view.ref} ${name} give back`, name === 'start' && ending.test(view.type_name));
  const [was_tried, set_tried] = useState(false);
  const asked = asked_by(view, name);
  const problems = problems_in(console, view.ref, asked, inputs);
  // Missing values are reported only after an attempt to send, other problems at once.
  const shown = was_tried
    ? problems
    : Object.fromEntries(Object.entries(problems).filter(([, one]) => one.what !== 'missing' && one.what !== 'either'));
  const unit = { ...command(view.ref, name), arguments: arguments_in(console, view.ref, asked, inputs) };
  const title = `${view.ref} ${name}`;
  const timeout = view.commands.find((one) => one.name === name)?.timeout;
  return (
    <Form class="component-form">
      {asked.length > 0 && <ArgumentFields view={view} asked={asked} inputs={inputs} change={change} problems={shown} />}
      {misplaced(console, unit).map((text) => <p key={text} class="exchange-why">{text}</p>)}
      {timeout !== undefined && <p class="soft">{texts.start_within(duration(timeout))}</p>}
      <Exchange
        by_enter
        title={title}
        operation="execute"
        label={name}
        request={written(() => request('execute', {}, sequence_xml([unit])))}
        may_send={() => {
          set_tried(true);
          return Object.keys(problems).length === 0;
        }}
        act={() => console.execute([unit], { give_back })}
      >
        <Checkbox label={texts.given_back()} checked={give_back} change={set_give_back} />
      </Exchange>
      <Others view={view} title={title} />
    </Form>
  );
}

// Open commands on this component that another form or panel sent.
function Others({ view, title }: { view: ComponentView; title: string }) {
  const { commands } = useConsole();
  void commands.pulse.beat.value;
  const own_document = last_outcome(title)?.request?.number;
  const open = commands.open().filter((one) => one.component === view.ref && one.sequence.document !== own_document);
  return <>{open.map((one) => <CommandProgress key={one.id} entry={one} />)}</>;
}

/** The document, or an empty text if XML does not allow one of its characters. */
export function written(make: () => string): string {
  try {
    return make();
  } catch {
    return '';
  }
}
