// Draws the panels: in up to three areas on a wide screen, behind one row of tabs on a narrow one.
import type { ComponentType } from 'preact';
import { useEffect, useState } from 'preact/hooks';

import { useConsole } from '../context';
import { SplitPane } from '../ui/split_pane';
import { Loading } from '../ui/states';
import { Tabs } from '../ui/tabs';
import { Boundary } from './boundary';
import { type Area, areas, in_front, is_wide, type Panel, panels_of, show_panel, shown } from './navigation';
import * as texts from './texts';

const area_names: Record<Area, () => string> = { main: texts.main, below: texts.below, side: texts.side };

export function Layout() {
  const { environment } = useConsole();
  const now = shown.value;
  useEffect(() => environment.remember('panels', `${now.main} ${now.below} ${now.side} ${now.all}`), [now]);
  if (!is_wide.value) return <Group id="all" label={texts.panels()} />;
  const [main, below, side] = areas.map((area) =>
    panels_of(area).length === 0 ? undefined : <Group id={area} label={area_names[area]()} />,
  );
  const left =
    main && below ? (
      <SplitPane id="below" direction="column" share={0.62} label={texts.below()} first={main} second={below} />
    ) : (
      (main ?? below)
    );
  if (!left || !side) return left ?? side ?? null;
  return <SplitPane id="side" direction="row" share={0.64} label={texts.side()} first={left} second={side} />;
}

function Group({ id, label }: { id: Area | 'all'; label: string }) {
  const panel = in_front(id);
  if (!panel) return null;
  const tabs = panels_of(id).map((one) => ({ id: one.id, title: one.title(), icon: one.icon }));
  return (
    <Tabs label={label} tabs={tabs} chosen={panel.id} choose={show_panel}>
      <div key={panel.id} class={`panel panel-${panel.id}`}>
        <Boundary>
          <Content panel={panel} />
        </Boundary>
      </div>
    </Tabs>
  );
}

// Loaded panels.
const loaded = new Map<Panel, ComponentType>();

// An error while loading is shown by the Boundary, whose button tries again. Older browsers remember the error (whatwg/html#10327): there,
// only reloading the page helps, as the Boundary's hint says.
function Content({ panel }: { panel: Panel }) {
  const [failed, fail] = useState<{ why: unknown }>();
  const [, arrive] = useState(0);
  const Loaded = loaded.get(panel);
  useEffect(() => {
    if (Loaded) return;
    panel.load().then(
      ({ default: Arrived }) => {
        loaded.set(panel, Arrived);
        arrive(1);
      },
      (why: unknown) => fail({ why }),
    );
  }, []);
  if (failed) throw failed.why;
  return Loaded ? <Loaded /> : <Loading />;
}
