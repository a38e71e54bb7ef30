// Where the panels stand: on a wide screen in up to three areas at once, on a narrower one behind one row of tabs.
import { type Signal, signal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import type { Area, Panel } from '../panels';
import type { Console } from '../state/console';
import { SplitPane } from '../ui/split_pane';
import { Tabs } from '../ui/tabs';
import { Boundary } from './boundary';
import { useConsole } from './context';
import * as texts from './texts';

let panels: readonly Panel[] = [];
const wide = signal(true);
/** The header is a menu. */
export const is_narrow = signal(false);
const areas: readonly Area[] = ['main', 'below', 'side'];
const area_names: Record<Area, () => string> = { main: texts.main, below: texts.below, side: texts.side };

/** Which panel is shown, in each area and, on a narrow screen, in all. */
const shown = signal<Readonly<Record<Area | 'all', string>>>({ main: '', below: '', side: '', all: '' });

/** Shows a panel, wherever it stands. Panels use it to lead from one to the other. */
export function show_panel(id: string): void {
  const panel = panels.find((one) => one.id === id);
  if (!panel) return;
  shown.value = { ...shown.value, [panel.area]: id, all: id };
  history.replaceState(null, '', `#${id}`);
}

/** Shows a component among the others. */
export function show_component({ selection }: Console, ref: string): void {
  selection.component.value = ref;
  show_panel('components');
}

/** Shows a document among the others. */
export function show_document({ selection }: Console, number: number): void {
  selection.wanted.value = number;
  show_panel('messages');
}

/** Shows the events of a subscription, and nothing else. */
export function show_events({ selection }: Console, subscribe_id: string): void {
  selection.subscription.value = subscribe_id;
  show_panel('messages');
}

/** Begins with these panels, those in front that are recalled, and follows the width of the window and the address. */
export function begin_layout(all: readonly Panel[], recalled: string | undefined): void {
  panels = all;
  follow('(min-width: 1100px)', wide);
  follow('(max-width: 1099px)', is_narrow);
  const from_address = () => show_panel(location.hash.slice(1));
  addEventListener('hashchange', from_address);
  for (const id of (recalled ?? '').split(' ')) {
    const panel = panels.find((one) => one.id === id);
    if (panel) shown.value = { ...shown.value, [panel.area]: id, all: id };
  }
  from_address();
}

function follow(query: string, answer: Signal<boolean>): void {
  const list = matchMedia(query);
  const read = () => (answer.value = list.matches);
  list.addEventListener('change', read);
  read();
}

export function Layout() {
  const { environment } = useConsole();
  const now = shown.value;
  useEffect(() => environment.remember('panels', `${now.main} ${now.below} ${now.side} ${now.all}`), [now]);
  if (!wide.value) return <Group id="all" label={texts.panels()} panels={panels} />;
  const [main, below, side] = areas.map((area) => {
    const those = panels.filter((one) => one.area === area);
    return those.length === 0 ? undefined : <Group id={area} label={area_names[area]()} panels={those} />;
  });
  const left = main && below ? <SplitPane id="below" direction="column" share={0.62} label={texts.below()} first={main} second={below} /> : (main ?? below);
  if (!left || !side) return left ?? side ?? null;
  return <SplitPane id="side" direction="row" share={0.64} label={texts.side()} first={left} second={side} />;
}

function Group({ id, label, panels: those }: { id: Area | 'all'; label: string; panels: readonly Panel[] }) {
  const chosen = those.find((one) => one.id === shown.value[id]) ?? those[0];
  if (!chosen) return null;
  const tabs = those.map((one) => ({ id: one.id, title: one.title(), icon: one.icon }));
  return (
    <Tabs label={label} tabs={tabs} chosen={chosen.id} choose={show_panel}>
      <div key={chosen.id} class={`panel panel-${chosen.id}`}>
        <Boundary>
          <chosen.Content />
        </Boundary>
      </div>
    </Tabs>
  );
}
