// Common conditions to start with, shown while there is no condition.
import { Button } from '../ui';
import { type AreaKind, type Group, new_area, new_predicate, new_sort_key, type Node, type Operator, with_added } from './model';
import type { ConditionStore } from './store';
import * as texts from './texts';

export function Beginnings({ store }: { store: ConditionStore }) {
  const { purpose, root } = store.draft.value;
  const add = (...nodes: Node[]) => store.change_root((group) => nodes.reduce<Group>((to, node) => with_added(to, root.id, node), group));
  const place = (reference: string, operator: Operator, kind: AreaKind, distance = '') =>
    add(new_predicate({ reference, operator, area: new_area(kind), distance }));
  const position = store.references.value.find((one) => one.type === 'position' && one.of === 'result' && one.path !== 'located')?.path;
  return (
    <div class="conditions-beginnings">
      <p>{texts.nothing_yet()}</p>
      <div class="conditions-chips">
        {position && (
          <>
            <Chip label={texts.begin_box(position)} act={() => place(position, 'Within', 'box')} />
            <Chip label={texts.begin_place(position)} act={() => place(position, 'Within', 'place')} />
            <Chip label={texts.begin_near(position)} act={() => place(position, 'DWithin', 'point', '2000')} />
          </>
        )}
        {(purpose === 'search' || purpose === 'bind_any') && (
          <>
            <Chip label={texts.begin_type()} act={() => add(new_predicate({ reference: 'component_type' }))} />
            <Chip
              label={texts.begin_ready()}
              act={() => add(new_predicate({ reference: 'status', value: 'READY' }), new_predicate({ reference: 'bound', value: 'false' }))}
            />
            <Chip
              label={texts.begin_nearest()}
              act={() => store.change({ order: [new_sort_key({ by: 'distance', reference: 'location', area: new_area('place') })] })}
            />
          </>
        )}
        {(purpose === 'subscribe' || purpose === 'query') && (
          <Chip label={texts.begin_ref()} act={() => add(new_predicate({ reference: 'component_ref' }))} />
        )}
      </div>
    </div>
  );
}

function Chip({ label, act }: { label: string; act: () => void }) {
  return (
    <Button small icon="plus" onClick={act}>
      {label}
    </Button>
  );
}
