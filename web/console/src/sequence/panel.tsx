// The Sequence panel: an editor for `execute` that draws, validates and runs sequences and shows their progress.
import './sequence.css';

import { useEffect, useRef, useState } from 'preact/hooks';

import { useConsole, useWatch } from '../context';
import * as panel_titles from '../shell/panel_titles';
import { Button, CurlButton, EmptyState, Tabs, useIsWide, WidthSplit, XmlView } from '../ui';
import { Drawing } from './drawing';
import { Inspector } from './inspector';
import { LibraryDialog } from './library_dialog';
import { commands_in, new_command, new_lane, new_parallel, type Slot, type Step, with_inserted } from './model';
import { RunSummary } from './run_summary';
import { type SequenceStore, store_of } from './store';
import * as texts from './texts';
import { Toolbar } from './toolbar';

type Part = 'step' | 'xml';

export default function SequencePanel() {
  const console = useConsole();
  const store = store_of(console);
  const [adding, set_adding] = useState<Slot>();
  const [part, set_part] = useState<Part>('step');
  const [library, set_library] = useState(false);
  const [panes, is_wide] = useIsWide(860);
  const below = useRef<HTMLDivElement>(null);
  const root = store.root.value;
  const refs = [...new Set(commands_in(root).map((one) => one.component))].filter((ref) => console.profile.component(ref) !== undefined);
  const open_form = () => {
    set_part('step');
    requestAnimationFrame(() => below.current?.querySelector<HTMLElement>('select, input')?.focus());
  };
  useEffect(() => set_part('step'), [store.chosen.value]);
  const knows_profile = console.profile.profile.value !== undefined;
  return (
    <div class="sequence">
      <h2 class="unseen">{panel_titles.sequence()}</h2>
      {refs.map((ref) => <Looks key={ref} component={ref} />)}
      <Toolbar store={store} set_adding={set_adding} open_library={() => set_library(true)} />
      <RunSummary store={store} />
      <div class="sequence-panes" ref={panes}>
        <WidthSplit
          is_wide={is_wide}
          row={{ id: 'sequence.row', share: 0.62 }}
          column={{ id: 'sequence' }}
          label={texts.resize()}
          first={
            !knows_profile ? (
              <EmptyState icon="sequence" title={texts.no_profile()} />
            ) : root.steps.length === 0 && !adding ? (
              <Beginning store={store} open_form={open_form} />
            ) : (
              <Drawing store={store} adding={adding} set_adding={set_adding} open_form={open_form} />
            )
          }
          second={
            <div class="sequence-below" ref={below}>
              <Tabs<Part>
                label={texts.parts()}
                tabs={[
                  { id: 'step', title: texts.step() },
                  { id: 'xml', title: 'XML' },
                ]}
                chosen={part}
                choose={set_part}
              >
                <div class="sequence-part" tabIndex={0} role="region" aria-label={texts.parts()}>
                  {part === 'step' ? <Inspector store={store} /> : <AsXml store={store} />}
                </div>
              </Tabs>
            </div>
          }
        />
      </div>
      <LibraryDialog store={store} open={library} close={() => set_library(false)} />
    </div>
  );
}

// Parameters that a component already has may be omitted.
function Looks({ component }: { component: string }) {
  useWatch(useConsole().parameters.poll(component));
  return null;
}

function Beginning({ store, open_form }: { store: SequenceStore; open_form: () => void }) {
  const begin = (step: Step, chosen: Step) => {
    store.change(with_inserted(store.root.value, { lane: store.root.value.id, index: 0 }, step));
    store.chosen.value = chosen.id;
    open_form();
  };
  const both = () => {
    const first = new_command();
    begin(new_parallel([new_lane([first]), new_lane([new_command()])]), first);
  };
  const one = () => {
    const first = new_command();
    begin(first, first);
  };
  return (
    <EmptyState icon="sequence" title={texts.empty()}>
      <div class="row sequence-beginning">
        <Button look="primary" icon="plus" onClick={one}>
          {texts.begin_command()}
        </Button>
        <Button icon="sequence" onClick={both}>
          {texts.begin_parallel()}
        </Button>
      </div>
    </EmptyState>
  );
}

function AsXml({ store }: { store: SequenceStore }) {
  const { request } = store;
  if (commands_in(store.root.value).length === 0) return <p class="field-hint">{texts.nothing()}</p>;
  return (
    <div class="sequence-xml">
      <div class="row">
        <CurlButton request={request} disabled={request === ''} />
        <span class="field-hint">{texts.curl_hint()}</span>
      </div>
      <XmlView text={request} label={texts.request()} />
    </div>
  );
}
