// Uses the condition: shows its request, sends it, and shows the outcome.
import type { Operation } from 'rois-client';

import { useConsole } from '../context';
import { Exchange } from '../forms/exchange';
import { Checkbox, type IconName } from '../ui';
import { is_complete } from './checking';
import type { Purpose } from './model';
import type { ConditionStore } from './store';
import * as texts from './texts';
import { condition_of, request_of } from './writing';

const icons: Record<Purpose, IconName> = { search: 'search', bind_any: 'link', subscribe: 'messages', query: 'info' };

export function UseView({ store }: { store: ConditionStore }) {
  const console = useConsole();
  const draft = store.draft.value;
  const references = store.references.value;
  const condition = condition_of(draft, references);
  const operation: Operation = draft.purpose;
  const act = (): Promise<unknown> => {
    switch (draft.purpose) {
      case 'search':
        return console.search(condition);
      case 'bind_any':
        return console.client.bind_any(condition);
      case 'subscribe':
        return store.subscribe(draft.event_type, condition, draft.inline_results);
      case 'query':
        return console.query(draft.query_type, condition);
    }
  };
  const complete = is_complete(draft, references);
  return (
    <section class="conditions-part" aria-label={texts.request()}>
      <h3>{texts.request()}</h3>
      {draft.purpose === 'subscribe' && (
        <Checkbox label={texts.details()} checked={draft.inline_results} change={(inline_results) => store.change({ inline_results })} />
      )}
      {!complete && <p class="field-hint">{texts.incomplete_request()}</p>}
      <Exchange
        key={draft.purpose}
        title={draft.purpose}
        operation={operation}
        request={request_of(draft, condition)}
        act={act}
        can_send={complete}
        label={texts.action_named(draft.purpose)}
        icon={icons[draft.purpose]}
      />
    </section>
  );
}
