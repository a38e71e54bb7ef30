// What is done with the condition: the request that it makes, and what came of it.
import { useState } from 'preact/hooks';

import { useConsole } from '../shell/context';
import { Button, Checkbox, CurlButton, error_text, Table, XmlView } from '../ui';
import { is_complete } from './checking';
import type { ConditionStore } from './store';
import { Subscriptions } from './subscriptions';
import { texts } from './texts';
import { condition_of, request_of } from './writing';

interface Outcome {
  text: string;
  is_bad?: boolean;
  bound?: string; // what can be released again
  answer?: { ref: string; rows: { name: string; values: string[] }[] };
}

export function UseView({ store }: { store: ConditionStore }) {
  const t = texts();
  const console = useConsole();
  const [outcome, set_outcome] = useState<Outcome>();
  const [busy, set_busy] = useState(false);
  const draft = store.draft.value;
  const references = store.references.value;
  const condition = condition_of(draft, references);
  const request = request_of(draft, condition);
  const use = async (): Promise<Outcome> => {
    switch (draft.purpose) {
      case 'search':
        return { text: t.done_search((await console.search(condition)).length) };
      case 'bind_any': {
        const { code } = await console.client.bind_any(condition);
        return { text: t.done_bind_any(code), bound: code };
      }
      case 'subscribe':
        await store.subscribe(draft.event_type, condition, draft.inline_results);
        return { text: t.done_subscribe(draft.event_type) };
      case 'query': {
        const { component_ref, results } = await console.query(draft.query_type, condition);
        return { text: t.answer(component_ref.code), answer: { ref: component_ref.code, rows: results.parameters } };
      }
    }
  };
  const pressed = async () => {
    set_busy(true);
    set_outcome(await use().catch((error: unknown): Outcome => ({ text: error_text(error), is_bad: true })));
    set_busy(false);
  };
  const release = (ref: string) => void console.bindings.release(ref).then(() => set_outcome(undefined), (error: unknown) => set_outcome({ text: error_text(error), is_bad: true }));
  return (
    <section class="conditions-part" aria-label={t.request}>
      <h3>{t.request}</h3>
      {draft.purpose === 'subscribe' && <Checkbox label={t.details} checked={draft.inline_results} change={(inline_results) => store.change({ inline_results })} />}
      <div class="conditions-actions">
        <Button look="primary" busy={busy} disabled={!is_complete(draft, references) || !console.link.is_open} onClick={() => void pressed()}>
          {t[`do_${draft.purpose}`]}
        </Button>
        <CurlButton request={request} />
        {outcome?.bound !== undefined && <Button small onClick={() => release(outcome.bound!)}>{t.release}</Button>}
      </div>
      <p class={outcome?.is_bad ? 'field-error' : 'conditions-outcome'} role="status">
        {outcome?.text ?? ''}
      </p>
      {outcome?.answer && (
        <Table
          label={t.answer(outcome.answer.ref)}
          columns={[{ id: 'name', title: t.name, cell: (row) => row.name }, { id: 'value', title: t.value, cell: (row) => row.values.join(', ') }]}
          rows={outcome.answer.rows}
          key_of={(row) => row.name}
        />
      )}
      <XmlView text={request} label={t.request_label} />
      <Subscriptions store={store} />
    </section>
  );
}
