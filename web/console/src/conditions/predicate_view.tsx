// One predicate: reference, operator and value.
import { useState } from 'preact/hooks';

import { Badge, Checkbox, Field, IconButton, SelectField } from '../ui';
import { AreaFields } from './area_fields';
import { problems_of } from './checking';
import { type AreaKind, type Node, type Operator, type Predicate, with_changed } from './model';
import type { ConditionStore } from './store';
import * as texts from './texts';
import { complaint_of, ValueFields } from './value_fields';
import { is_spatial, operators_for, type Reference, resolved } from './vocabulary';

export function PredicateView({
  store,
  predicate,
  remove,
  wrap,
}: {
  store: ConditionStore;
  predicate: Predicate;
  remove: () => void;
  wrap: () => void;
}) {
  const references = store.references.value;
  const reference = resolved(predicate.reference, references);
  const is_usual = !predicate.is_not && predicate.match_case && predicate.matching === 'Any';
  const [more, set_more] = useState(false);
  const change = (to: Partial<Predicate>) =>
    store.change_root((root) => with_changed(root, predicate.id, (one) => ({ ...one, ...to }) as Node));
  const found = problems_of(predicate, references);
  return (
    <div class="conditions-predicate">
      <div class="conditions-line">
        {predicate.is_not && <Badge tone="warning">{texts.negated()}</Badge>}
        <ReferenceField
          value={predicate.reference}
          references={references}
          {...complaint_of(found, 'reference')}
          change={(path) => change(about(predicate, path, references))}
        />
        <OperatorField predicate={predicate} reference={reference} change={change} />
        {!is_spatial(predicate.operator) && <ValueFields predicate={predicate} reference={reference} found={found} change={change} />}
      </div>
      <div class="conditions-tools">
        <IconButton small icon="more" label={texts.more()} aria-expanded={more || !is_usual} onClick={() => set_more(!more)} />
        <IconButton small icon="components" label={texts.wrap()} onClick={wrap} />
        <IconButton small icon="close" label={texts.remove()} onClick={remove} />
      </div>
      {is_spatial(predicate.operator) && (
        <AreaFields
          area={predicate.area}
          change={(area) => change({ area })}
          {...complaint_of(found, 'area')}
          known={store.known.value}
          {...(needs_distance(predicate) && {
            distance: predicate.distance,
            change_distance: (distance: string) => change({ distance }),
            distance_complaint: complaint_of(found, 'distance'),
          })}
        />
      )}
      {(more || !is_usual) && (
        <div class="conditions-more">
          <Checkbox label={texts.negate()} checked={predicate.is_not} change={(is_not) => change({ is_not })} />
          {has_case(predicate, reference) && (
            <Checkbox label={texts.ignore_case()} checked={!predicate.match_case} change={(ignore) => change({ match_case: !ignore })} />
          )}
          {has_matching(predicate, reference) && (
            <SelectField
              label={texts.of_list()}
              value={predicate.matching}
              change={(matching) => change({ matching })}
              choices={[
                { value: 'Any', label: texts.of_any() },
                { value: 'All', label: texts.of_all() },
                { value: 'One', label: texts.of_one() },
              ]}
            />
          )}
        </div>
      )}
    </div>
  );
}

function needs_distance({ operator }: Pick<Predicate, 'operator'>): boolean {
  return operator === 'DWithin' || operator === 'Beyond';
}

function has_case({ operator }: Predicate, reference: Reference | undefined): boolean {
  return operator === 'Like' || ((operator === 'EqualTo' || operator === 'NotEqualTo') && (reference?.type ?? 'text') === 'text');
}

function has_matching({ operator }: Predicate, reference: Reference | undefined): boolean {
  return (reference?.is_list ?? false) && /Than|EqualTo/.test(operator);
}

/** The changes for another reference. */
export function about(predicate: Predicate, path: string, references: readonly Reference[]): Partial<Predicate> {
  const [before, now] = [resolved(predicate.reference, references), resolved(path, references)];
  const operators = operators_for(now?.type ?? 'text');
  const same_values = before?.type === now?.type && before?.options === now?.options;
  return {
    reference: path,
    ...(!operators.includes(predicate.operator) && { operator: operators[0]! }),
    ...(!same_values && { value: '', upper: '' }),
    ...(now?.type === 'position' && before?.type !== 'position' && { area: { ...predicate.area, kind: 'box' as const } }),
    ...(!now?.is_list && { matching: 'Any' as const }),
  };
}

export interface ReferenceFieldProps {
  value: string;
  references: readonly Reference[];
  error?: string;
  hint?: string;
  change: (path: string) => void;
}

export function ReferenceField({ value, references, error, hint, change }: ReferenceFieldProps) {
  const chosen = resolved(value, references);
  const groups = [['result', texts.results()], ['component', texts.component()], ['parameter', texts.parameters()]] as const;
  const is_listed = references.some((one) => one.path === value);
  return (
    <div class="conditions-reference">
      <Field
        label={texts.reference()}
        error={error}
        hint={value !== '' && !chosen ? texts.unknown_reference() : hint}
        control={(props) => (
          <select {...props} value={value} title={chosen?.description} onChange={(event) => change(event.currentTarget.value)}>
            {value === '' && <option value="">{texts.choose()}</option>}
            {value !== '' && !is_listed && <option value={value}>{value}</option>}
            {groups.map(([of, name]) => {
              const group = references.filter((one) => one.of === of);
              return (
                group.length > 0 && (
                  <optgroup key={of} label={name}>
                    {group.map((one) => (
                      <option key={one.path} value={one.path}>
                        {one.path}
                      </option>
                    ))}
                  </optgroup>
                )
              );
            })}
          </select>
        )}
      />
    </div>
  );
}

// Spatial operators are listed once for each kind of area.
function OperatorField({
  predicate,
  reference,
  change,
}: {
  predicate: Predicate;
  reference: Reference | undefined;
  change: (to: Partial<Predicate>) => void;
}) {
  const usual = operators_for(reference?.type ?? 'text');
  const operators = usual.includes(predicate.operator) ? usual : [...usual, predicate.operator];
  const kinds = (operator: Operator): AreaKind[] => {
    if (needs_distance({ operator })) return ['point', 'place', 'box'];
    return operator === predicate.operator && predicate.area.kind === 'point' ? ['box', 'place', 'point'] : ['box', 'place'];
  };
  const choices = operators.flatMap((one) => (is_spatial(one) ? kinds(one).map((kind) => `${one}_${kind}`) : [one]));
  const chosen = is_spatial(predicate.operator) ? `${predicate.operator}_${predicate.area.kind}` : predicate.operator;
  const choose = (to: string) => {
    const [operator, kind] = to.split('_') as [Operator, AreaKind | undefined];
    change({ operator, ...(kind && { area: { ...predicate.area, kind } }) });
  };
  return (
    <div class="conditions-operator">
      <SelectField
        label={texts.operator()}
        value={chosen}
        change={choose}
        choices={choices.map((one) => ({ value: one, label: texts.operator_named(one) }))}
      />
    </div>
  );
}
