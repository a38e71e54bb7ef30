// Arguments and results of RoIS, as a small table.
import type { Parameter } from 'rois-client';

import { Table } from './table';
import { texts } from './texts';

const most_shown = 50; // values of one

export function ParameterTable({ label, parameters }: { label: string; parameters: readonly Parameter[] }) {
  const t = texts();
  return (
    <Table
      label={label}
      rows={parameters}
      key_of={(one) => one.name}
      columns={[
        { id: 'name', title: t.name, cell: (one) => <span title={one.data_type_ref.code}>{one.name}</span> },
        { id: 'value', title: t.value, cell: (one) => <Values values={one.values} /> },
      ]}
    />
  );
}

function Values({ values }: { values: readonly string[] }) {
  const t = texts();
  if (values.length === 0) return <span class="parameter-none">{t.no_value}</span>;
  return (
    <>
      {values.slice(0, most_shown).map((one, i) => <div key={i} class="parameter-value">{one}</div>)}
      {values.length > most_shown && <div class="parameter-none">{t.more_values(values.length - most_shown)}</div>}
    </>
  );
}
