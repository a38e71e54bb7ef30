import type { ComponentChildren } from 'preact';

export interface Column<Row> {
  id: string;
  title: string;
  cell: (row: Row) => ComponentChildren;
  numeric?: boolean;
}

export interface TableProps<Row> {
  label: string;
  columns: readonly Column<Row>[];
  rows: readonly Row[];
  key_of: (row: Row) => string | number;
  /** Shown if there are no rows. */
  empty?: ComponentChildren;
}

/** For some dozens of rows; use VirtualList for thousands. */
export function Table<Row>({ label, columns, rows, key_of, empty }: TableProps<Row>) {
  if (rows.length === 0 && empty !== undefined) return <>{empty}</>;
  return (
    <div class="table-frame" tabIndex={0} role="region" aria-label={label}>
      <table class="table">
        <thead>
          <tr>
            {columns.map((one) => (
              <th key={one.id} scope="col" class={one.numeric ? 'numeric' : undefined}>
                {one.title}
              </th>
            ))}
          </tr>
        </thead>
        <tbody>
          {rows.map((row) => (
            <tr key={key_of(row)}>
              {columns.map((one) => (
                <td key={one.id} class={one.numeric ? 'numeric' : undefined}>
                  {one.cell(row)}
                </td>
              ))}
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}
