import type { Parameter, Results } from 'rois-client';

import { Table } from '../ui';
import { with_name } from './codebooks';
import * as texts from './exchange_texts';

/** Table of results or parameters: name, value, type. */
export function ResultsTable({ label, results }: { label: string; results: Results }) {
  return (
    <Table<Parameter>
      label={label}
      rows={results.parameters}
      key_of={(one) => one.name}
      columns={[
        { id: 'name', title: texts.name(), cell: (one) => one.name },
        {
          id: 'value',
          title: texts.value(),
          cell: (one) => <Values values={results.texts(one.name).map((text) => with_name(one.data_type_ref.codebook_ref, text))} />,
        },
        {
          id: 'type',
          title: texts.type(),
          cell: (one) => (
            <span class="results-type" title={one.data_type_ref.codebook_ref}>
              {one.data_type_ref.code}
            </span>
          ),
        },
      ]}
    />
  );
}

// Long texts are listed vertically, short ones side by side.
function Values({ values }: { values: string[] }) {
  const are_long = values.some((text) => text.length > 12);
  return (
    <span class={are_long ? `results-values results-below${values.length > 8 ? ' results-many' : ''}` : 'results-values'}>
      {values.map((text, i) => (
        <span key={i}>{text === '' ? '“”' : text}</span>
      ))}
    </span>
  );
}
