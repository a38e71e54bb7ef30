// What the engine has, as a tree of engines and components, and how each component is.
import './components.css';

import { useConsole, useWatch } from '../shell/context';
import type { ComponentView, EngineView } from '../state/profile_state';
import { EmptyState, StatusBadge } from '../ui';
import { texts } from './texts';

export default function ComponentsPanel() {
  const { profile, status, metrics } = useConsole();
  useWatch(status.poll);
  useWatch(metrics.poll);
  const engine = profile.engine.value;
  if (!engine) return <EmptyState icon="components" title={texts().none} />;
  return (
    <div class="engine-frame" role="region" aria-label={texts().tree} tabIndex={0}>
      <ul class="engine-tree">
        <Engine engine={engine} />
      </ul>
    </div>
  );
}

function Engine({ engine }: { engine: EngineView }) {
  return (
    <li>
      <h2 title={engine.identifier}>{engine.name}</h2>
      <ul>
        {engine.components.map((one) => <Row key={one.ref} component={one} />)}
        {engine.sub_engines.map((one) => <Engine key={one.name} engine={one} />)}
      </ul>
    </li>
  );
}

function Row({ component }: { component: ComponentView }) {
  const { status, bindings } = useConsole();
  const entry = status.of(component.ref);
  const holder = bindings.holder_of(component.ref);
  return (
    <li class="engine-component" title={component.description}>
      <span class="engine-ref">{component.ref}</span>
      <span class="engine-type">{component.type_name}</span>
      {holder.who !== 'nobody' && <span class="engine-holder">{holder.who === 'me' ? texts().mine : texts().other(holder.session)}</span>}
      {entry ? <StatusBadge status={entry.status} title={entry.trouble} /> : <span class="engine-holder">{texts().unasked}</span>}
    </li>
  );
}
