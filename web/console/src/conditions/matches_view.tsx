// The components that match the condition now.
import { useEffect } from 'preact/hooks';

import { useConsole, useWatch } from '../context';
import { show_component } from '../shell/navigation';
import { error_text, StatusBadge } from '../ui';
import { problems_of } from './checking';
import { component_part, waits_for_results } from './matches';
import type { Draft } from './model';
import type { ConditionStore } from './store';
import * as texts from './texts';

export function MatchesView({ store }: { store: ConditionStore }) {
  const console = useConsole();
  const { profile, status, link } = console;
  const draft = store.draft.value;
  const references = store.references.value;
  const condition = component_part(draft, references);
  const missing = problems_of(draft.root, references).length;
  useWatch(status.poll);
  useWatch(store.matches);
  useEffect(
    () => store.matches.look_for(condition, eligible(draft, profile.components.value)),
    [condition.xml, draft.purpose, draft.event_type, draft.query_type, profile.reported_at.value],
  );
  const found = store.matches.found.value;
  const shown = found?.refs.filter(eligible(draft, profile.components.value)) ?? [];
  return (
    <section class="conditions-part" aria-label={texts.matches()}>
      <h3>{texts.matches()}</h3>
      <p class={found?.is_old ? 'conditions-count conditions-old' : 'conditions-count'} role="status">
        {found && !found.trouble
          ? counted(draft, shown.length, profile.components.value.length)
          : link.is_open && !found
            ? texts.looking()
            : ''}
      </p>
      {found?.trouble !== undefined && <p class="field-error">{error_text(found.trouble)}</p>}
      {missing > 0 && <p class="field-hint">{texts.incomplete(missing)}</p>}
      {waits_for_results(draft, references) && <p class="field-hint">{texts.on_results()}</p>}
      <ol class="conditions-found" aria-label={texts.found()}>
        {shown.map((ref, i) => {
          const entry = status.of(ref);
          return (
            <li key={ref}>
              {draft.order.length > 0 && <span class="conditions-type">{i + 1}</span>}
              <button type="button" class="conditions-ref" title={texts.open_component()} onClick={() => show_component(console, ref)}>
                {ref}
              </button>
              <span class="conditions-type conditions-fill">{profile.component(ref)?.type_name}</span>
              {entry && <StatusBadge status={entry.status} />}
            </li>
          );
        })}
      </ol>
    </section>
  );
}

function counted({ purpose }: Draft, found: number, all: number): string {
  if (purpose === 'subscribe') return texts.can_match(found);
  return purpose === 'query' ? texts.can_answer(found) : texts.matching(found, all);
}

// Components with the event or query.
function eligible(
  { purpose, event_type, query_type }: Draft,
  components: readonly { ref: string; events: { name: string }[]; queries: { name: string }[] }[],
): (ref: string) => boolean {
  if (purpose !== 'subscribe' && purpose !== 'query') return () => true;
  const candidates = components.filter((one) =>
    purpose === 'subscribe' ? one.events.some(({ name }) => name === event_type) : one.queries.some(({ name }) => name === query_type),
  );
  const refs = new Set(candidates.map((one) => one.ref));
  return (ref) => refs.has(ref);
}
