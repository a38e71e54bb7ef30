// The Scenario panel: diagram, run and editing.
import './scenario.css';

import { useSignal } from '@preact/signals';

import { useConsole } from '../context';
import type { Notices } from '../state/notices';
import { Button, chosen_file, EmptyState, Icon, save_file, Tabs, TextArea, useIsWide, WidthSplit } from '../ui';
import { against_engine } from './against_engine';
import { type Desk, desk_of } from './desk';
import { Diagram } from './diagram';
import { EditView } from './edit_view';
import type { Problem } from './read';
import { RunState, RunView, state_of } from './run_view';
import type { Node } from './source';
import * as texts from './texts';

type Part = 'run' | 'edit' | 'xml';

const beside_from = 760; // px; below this width, the diagram is above the rest

export default function ScenarioPanel() {
  const console = useConsole();
  const desk = desk_of(console);
  const part = useSignal<Part>('run');
  const [frame, is_wide] = useIsWide(beside_from);
  const scenario = desk.drawn.value;
  const edit = (state: string) => {
    desk.chosen.value = state;
    if (!desk.is_running.value) part.value = 'edit';
  };
  const tabs = [
    { id: 'run' as const, title: texts.tab_run(), icon: 'play' as const },
    { id: 'edit' as const, title: texts.tab_edit(), icon: 'sequence' as const },
    { id: 'xml' as const, title: texts.tab_xml(), icon: 'messages' as const },
  ];
  return (
    <div class="scenario-panel" ref={frame}>
      <Bar desk={desk} started={() => (part.value = 'run')} />
      <Problems desk={desk} choose={edit} />
      <div class="scenario-body">
        <WidthSplit
          is_wide={is_wide}
          row={{ id: 'scenario', share: 0.56 }}
          column={{ id: 'scenario-below' }}
          first={
            scenario ? <Diagram desk={desk} scenario={scenario} edit={edit} /> : <EmptyState icon="scenario" title={texts.cannot_draw()} />
          }
          second={
            <Tabs label={texts.tabs()} tabs={tabs} chosen={part.value} choose={(id) => (part.value = id)}>
              {part.value === 'run' && <RunView desk={desk} />}
              {part.value === 'edit' && <EditView desk={desk} />}
              {part.value === 'xml' && <XmlPart desk={desk} />}
            </Tabs>
          }
        />
      </div>
    </div>
  );
}

function Bar({ desk, started }: { desk: Desk; started: () => void }) {
  const { link, notices } = useConsole();
  const is_running = desk.is_running.value;
  const { scenario } = desk.reading.value;
  const why_not = !link.is_open ? texts.not_connected() : scenario ? undefined : texts.fix_first();
  const start = () => {
    started();
    void desk.start().then(() => show_end(desk, notices));
  };
  const open = async () => {
    const file = await chosen_file('.xml,application/xml,text/xml');
    if (!file) return;
    await file.text().then(
      (text) => desk.open(file.name, text),
      (error: unknown) => void notices.show('error', texts.file_unreadable(), { detail: String(error), about: 'scenario' }),
    );
  };
  return (
    <header class="scenario-bar">
      <div class="scenario-bar-title">
        <h2>{desk.drawn.value?.name || texts.unnamed()}</h2>
        <span class="scenario-soft">{desk.file_name.value}</span>
      </div>
      {is_running ? (
        <Button look="danger" icon="stop" onClick={() => desk.stop()}>{texts.stop()}</Button>
      ) : (
        <Button look="primary" icon="play" disabled={why_not !== undefined} title={why_not} onClick={start}>{texts.start()}</Button>
      )}
      <RunState desk={desk} />
      <div class="scenario-bar-end">
        <Button small look="quiet" icon="undo" disabled={is_running || !desk.can_undo.value} onClick={() => desk.undo()}>
          {texts.undo()}
        </Button>
        <Button
          small
          look="quiet"
          icon="refresh"
          title={texts.shipped_hint()}
          disabled={is_running || desk.is_as_shipped}
          onClick={() => desk.open_shipped()}
        >
          {texts.shipped()}
        </Button>
        <Button small look="quiet" icon="upload" disabled={is_running} onClick={() => void open()}>
          {texts.open()}
        </Button>
        <Button small look="quiet" icon="download" onClick={() => save_file(desk.file_name.value, [desk.text.value])}>
          {texts.save()}
        </Button>
      </div>
    </header>
  );
}

// A notice, because the user may be in another panel.
function show_end(desk: Desk, notices: Notices): void {
  const { tone, text, why } = state_of(desk.run, false);
  if (tone === 'calm') return;
  notices.show(tone === 'good' ? 'good' : 'error', `${desk.drawn.value?.name || texts.unnamed()}: ${text}`, {
    about: 'scenario',
    ...(why !== undefined && { detail: why }),
  });
}

// Errors, and warnings about the engine.
function Problems({ desk, choose }: { desk: Desk; choose: (state: string) => void }) {
  const { profile } = useConsole();
  const { problems, scenario, text } = desk.reading.value;
  const warnings = scenario && profile.profile.value ? against_engine(scenario, text, profile) : [];
  const all = problems.length > 0 ? problems : warnings;
  if (all.length === 0) return null;
  return (
    <details class={problems.length > 0 ? 'scenario-problems scenario-problems-bad' : 'scenario-problems'} open={problems.length > 0}>
      <summary>
        <Icon name="warning" /> {problems.length > 0 ? texts.problems() : texts.warnings()} ({all.length})
      </summary>
      <ul>
        {all.slice(0, 50).map((one) => <ProblemLine key={`${one.line} ${one.column} ${one.say()}`} problem={one} choose={choose} />)}
      </ul>
    </details>
  );
}

function ProblemLine({ problem, choose }: { problem: Problem; choose: (state: string) => void }) {
  const state = state_around(problem.node);
  const text = <><span class="scenario-soft">{texts.at_line(problem.line, problem.column)}</span> {problem.say()}</>;
  return <li>{state === undefined ? text : <button type="button" class="scenario-link" onClick={() => choose(state)}>{text}</button>}</li>;
}

function state_around(node: Node | undefined): string | undefined {
  if (!node) return undefined;
  return node.name === 'state' || node.name === 'end' ? (node.element.attribute('name') ?? '').trim() : state_around(node.parent);
}

function XmlPart({ desk }: { desk: Desk }) {
  return (
    <fieldset class="scenario-xml" disabled={desk.is_running.value}>
      {desk.is_running.value && <p class="scenario-locked"><Icon name="info" /> {texts.locked()}</p>}
      <TextArea label={texts.xml_label()} hide_label value={desk.text.value} change={(text) => desk.edit(text, 'xml')} rows={30} />
    </fieldset>
  );
}
