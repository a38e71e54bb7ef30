// A list of thousands of rows that renders only the visible ones. One row is selected; arrows, Page keys, Home and End move the
// selection.
import type { ComponentChildren } from 'preact';
import { useLayoutEffect, useRef, useState } from 'preact/hooks';

import { watch_size } from './use_width';

export interface VirtualListProps<Row> {
  label: string;
  rows: readonly Row[];
  row_height: number; // px, the same for all
  key_of: (row: Row) => string | number;
  render: (row: Row) => ComponentChildren;
  chosen?: string | number | undefined;
  choose: (row: Row) => void;
  /** Stays at the end when rows are added, unless the user has scrolled away. */
  follow?: boolean;
}

const spare = 6; // rows rendered beyond each edge

export function VirtualList<Row>({ label, rows, row_height, key_of, render, chosen, choose, follow = false }: VirtualListProps<Row>) {
  const frame = useRef<HTMLDivElement>(null);
  const [top, set_top] = useState(0);
  const [height, set_height] = useState(400);
  const at_end = useRef(true);
  const last_key = rows.length === 0 ? undefined : key_of(rows[rows.length - 1]!); // rows may be a list that grows in place

  useLayoutEffect(() => {
    const element = frame.current!;
    return watch_size(element, () => set_height(element.clientHeight));
  }, []);
  useLayoutEffect(() => {
    const element = frame.current!;
    if (follow && at_end.current) element.scrollTop = element.scrollHeight;
  }, [rows, last_key, follow]);

  const scrolled = () => {
    const element = frame.current;
    if (!element) return; // unmounted, but its last scroll event still arrives
    at_end.current = element.scrollTop + element.clientHeight >= element.scrollHeight - row_height;
    set_top(element.scrollTop);
  };
  const go = (index: number) => {
    const row = rows[Math.max(0, Math.min(rows.length - 1, index))];
    if (row === undefined) return;
    choose(row);
    const element = frame.current!;
    const y = rows.indexOf(row) * row_height;
    if (y < element.scrollTop) element.scrollTop = y;
    else if (y + row_height > element.scrollTop + element.clientHeight) element.scrollTop = y + row_height - element.clientHeight;
  };
  const pressed = (event: KeyboardEvent) => {
    const at = rows.findIndex((row) => key_of(row) === chosen);
    const page = Math.max(1, Math.floor(height / row_height) - 1);
    const to = {
      ArrowDown: at + 1,
      ArrowUp: at < 0 ? rows.length - 1 : at - 1,
      PageDown: at + page,
      PageUp: at - page,
      Home: 0,
      End: rows.length - 1,
    }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    go(to);
  };

  const first = Math.max(0, Math.floor(top / row_height) - spare);
  const last = Math.min(rows.length, Math.ceil((top + height) / row_height) + spare);
  const shown = rows.slice(first, last);
  const active = shown.find((row) => key_of(row) === chosen);
  return (
    <div
      ref={frame}
      class="virtual-list"
      role="listbox"
      aria-label={label}
      tabIndex={0}
      aria-activedescendant={active === undefined ? undefined : `row-${key_of(active)}`}
      onScroll={scrolled}
      onKeyDown={pressed}
    >
      <div class="virtual-list-whole" role="presentation" style={{ height: `${rows.length * row_height}px` }}>
        {shown.map((row, i) => (
          <div
            key={key_of(row)}
            id={`row-${key_of(row)}`}
            class="virtual-list-row"
            role="option"
            aria-selected={key_of(row) === chosen}
            aria-setsize={rows.length}
            aria-posinset={first + i + 1}
            style={{ top: `${(first + i) * row_height}px`, height: `${row_height}px` }}
            onClick={() => choose(row)}
          >
            {render(row)}
          </div>
        ))}
      </div>
    </div>
  );
}
