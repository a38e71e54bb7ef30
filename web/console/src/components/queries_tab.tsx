// The Queries tab: a form for each query of a component.
import { component_ref, condition_xml, request, text_element } from 'rois-client';

import { useConsole } from '../context';
import { Exchange, useDraft } from '../forms';
import type { ComponentView } from '../state/engine/profile_state';
import { Form } from '../ui';
import { Pick } from './pick';
import * as texts from './texts';

/** The names of its queries, as listed. */
export function query_names(view: ComponentView): string[] {
  return [...view.queries.map((one) => one.name), ...(view.parameters.length > 0 ? ['get_parameter'] : [])];
}

export function QueriesTab({ view }: { view: ComponentView }) {
  const console = useConsole();
  const names = query_names(view);
  const [name, choose] = useDraft(`${view.ref} query`, names[0] ?? '');
  if (!names.includes(name)) return <p>{texts.no_queries()}</p>;
  const query = view.queries.find((one) => one.name === name);
  const results = query?.results.map((one) => `${one.name} (${one.data_type_ref.code})`).join(', ') ?? '';
  const condition = component_ref(view.ref);
  return (
    <>
      <Pick label={texts.choose_query()} names={names} offered={view.queries} chosen={name} choose={choose} />
      <Form key={name} class="component-form">
        {results !== '' && <p class="soft">{texts.answers(results)}</p>}
        <Exchange
          by_enter
          title={`${view.ref} ${name}`}
          operation="query"
          label={name}
          icon="search"
          request={request('query', {}, text_element('query_type', name) + condition_xml(condition))}
          act={() => console.query(name, condition)}
        />
      </Form>
    </>
  );
}
