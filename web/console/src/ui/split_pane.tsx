// Two panes with a divider that is dragged or moved by arrow keys. Its position is stored.
import type { ComponentChildren } from 'preact';
import { useRef, useState } from 'preact/hooks';

import { useConsole } from '../context';
import * as texts from './texts';

export interface SplitPaneProps {
  /** Key of the stored position. */
  id: string;
  direction: 'row' | 'column';
  /** Initial share of the first pane, 0 to 1. */
  share?: number;
  label?: string;
  first: ComponentChildren;
  second: ComponentChildren;
}

const least = 0.15;

export function SplitPane({ id, direction, share: usual = 0.5, label, first, second }: SplitPaneProps) {
  const { environment } = useConsole();
  const frame = useRef<HTMLDivElement>(null);
  const [share, set_share] = useState(() => within(Number(environment.recall(`split.${id}`) ?? usual) || usual));
  const put = (to: number) => {
    set_share(within(to));
    environment.remember(`split.${id}`, within(to).toFixed(3));
  };
  const dragged = (event: PointerEvent) => {
    if (!(event.currentTarget as HTMLElement).hasPointerCapture(event.pointerId)) return;
    const box = frame.current!.getBoundingClientRect();
    put(direction === 'row' ? (event.clientX - box.left) / box.width : (event.clientY - box.top) / box.height);
  };
  const pressed = (event: KeyboardEvent) => {
    const [less, more] = direction === 'row' ? ['ArrowLeft', 'ArrowRight'] : ['ArrowUp', 'ArrowDown'];
    const to = { [less]: share - 0.02, [more]: share + 0.02, Home: least, End: 1 - least }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    put(to);
  };
  return (
    <div class={`split split-${direction}`} ref={frame}>
      <div class="split-pane" style={{ flexGrow: share }}>
        {first}
      </div>
      <div
        class="split-bar"
        role="separator"
        tabIndex={0}
        aria-orientation={direction === 'row' ? 'vertical' : 'horizontal'}
        aria-label={label ?? texts.resize()}
        aria-valuenow={Math.round(share * 100)}
        aria-valuemin={least * 100}
        aria-valuemax={(1 - least) * 100}
        onPointerDown={(event) => event.currentTarget.setPointerCapture(event.pointerId)}
        onPointerMove={dragged}
        onKeyDown={pressed}
      />
      <div class="split-pane" style={{ flexGrow: 1 - share }}>
        {second}
      </div>
    </div>
  );
}

type Place = Pick<SplitPaneProps, 'id' | 'share'>;

export interface WidthSplitProps extends Pick<SplitPaneProps, 'label' | 'first' | 'second'> {
  /** Whether the panes are side by side. */
  is_wide: boolean;
  /** Position of the divider between panes side by side. */
  row: Place;
  /** Position of the divider between panes one above the other. */
  column: Place;
}

/** Two panes side by side if there is room, else one above the other. Each arrangement has its own stored position. */
export function WidthSplit({ is_wide, row, column, ...panes }: WidthSplitProps) {
  const direction = is_wide ? 'row' : 'column';
  return <SplitPane key={direction} direction={direction} {...(is_wide ? row : column)} {...panes} />;
}

function within(share: number): number {
  return Math.min(1 - least, Math.max(least, share));
}
