// The order of the components, which also decides which one is chosen first.
import { Button, IconButton, SelectField } from '../ui';
import { AreaFields } from './area_fields';
import { area_problem } from './checking';
import { new_area, new_sort_key, type SortKey } from './model';
import { ReferenceField } from './predicate_view';
import type { ConditionStore } from './store';
import * as texts from './texts';
import { resolved } from './vocabulary';

export function SortView({ store }: { store: ConditionStore }) {
  const { order } = store.draft.value;
  const change = (id: number, to: Partial<SortKey>) =>
    store.change({ order: order.map((one) => (one.id === id ? { ...one, ...to } : one)) });
  return (
    <section class="conditions-part" aria-label={texts.sort()}>
      <h3>{texts.sort()}</h3>
      {order.length > 0 && <p class="field-hint">{texts.sort_hint()}</p>}
      <ol class="conditions-members">
        {order.map((one) => (
          <li key={one.id}>
            <Key
              store={store}
              sort_key={one}
              change={(to) => change(one.id, to)}
              remove={() => store.change({ order: order.filter((each) => each.id !== one.id) })}
            />
          </li>
        ))}
      </ol>
      <div class="conditions-add">
        <Button small icon="plus" onClick={() => store.change({ order: [...order, new_sort_key()] })}>
          {texts.add_sort()}
        </Button>
      </div>
    </section>
  );
}

function Key({
  store,
  sort_key: key,
  change,
  remove,
}: {
  store: ConditionStore;
  sort_key: SortKey;
  change: (to: Partial<SortKey>) => void;
  remove: () => void;
}) {
  const references = store.references.value;
  const positions = references.filter((one) => one.type === 'position');
  const choose_by = (by: SortKey['by']) =>
    change({
      by,
      area: new_area('place'),
      ...(by === 'distance' && resolved(key.reference, positions) === undefined && { reference: 'location' }),
    });
  const problem = key.by === 'distance' ? area_problem(key.area) : undefined;
  return (
    <div class="conditions-predicate">
      <div class="conditions-line">
        <SelectField
          label={texts.sort_by()}
          value={key.by}
          change={choose_by}
          choices={[
            { value: 'value', label: texts.sort_value() },
            { value: 'distance', label: texts.sort_distance() },
          ]}
        />
        <ReferenceField
          value={key.reference}
          references={key.by === 'distance' ? positions : references}
          change={(reference) => change({ reference })}
        />
        <SelectField
          label={texts.sort()}
          value={key.order}
          change={(order) => change({ order })}
          choices={[
            { value: 'ASC', label: texts.ascending() },
            { value: 'DESC', label: texts.descending() },
          ]}
        />
      </div>
      <div class="conditions-tools">
        <IconButton small icon="close" label={texts.remove_sort()} onClick={remove} />
      </div>
      {key.by === 'distance' && (
        <AreaFields
          area={key.area}
          change={(area) => change({ area })}
          {...(problem && { hint: texts.problem_named(problem) })}
          known={store.known.value}
        />
      )}
    </div>
  );
}
