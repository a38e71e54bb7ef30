// The Components panel: a tree of engines and components beside the selected component.
import './components.css';

import { useConsole, useWatch } from '../context';
import { EmptyState, useIsWide, WidthSplit } from '../ui';
import { Detail } from './detail';
import * as texts from './texts';
import { Tree } from './tree';

export default function ComponentsPanel() {
  const { profile, status, metrics, selection } = useConsole();
  useWatch(status.poll);
  useWatch(metrics.poll);
  const [frame, is_wide] = useIsWide(820); // for the tree and the component side by side
  const engine = profile.engine.value;
  const ref = selection.component.value;
  const view = profile.component(ref);
  const detail = view ? (
    <Detail key={ref} view={view} />
  ) : (
    <EmptyState icon="components" title={profile.is_empty.value ? texts.empty() : ref === '' ? texts.pick() : texts.gone(ref)} />
  );
  return (
    <div ref={frame} class={view || is_wide ? 'engine-panel' : 'engine-panel engine-alone'}>
      {!engine ? (
        <EmptyState icon="components" title={texts.none()} />
      ) : (
        <WidthSplit
          is_wide={is_wide}
          row={{ id: 'components.row', share: 0.34 }}
          column={{ id: 'components.column', share: 0.36 }}
          label={texts.tree()}
          first={<Tree engine={engine} />}
          second={detail}
        />
      )}
    </div>
  );
}
