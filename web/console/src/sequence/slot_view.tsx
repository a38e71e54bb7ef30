// The gap between two steps, where steps are added and dropped.
import type { ComponentChildren } from 'preact';
import { useLayoutEffect, useRef } from 'preact/hooks';

import { Button, IconButton, joined } from '../ui';
import type { LaneContext } from './lane_context';
import { new_command, new_parallel, new_wait, type Slot, type Step, with_inserted } from './model';
import * as texts from './texts';

export function SlotView({ slot, context, is_empty = false }: { slot: Slot; context: LaneContext; is_empty?: boolean }) {
  const { adding, set_adding, drag, store, go_to, open_form } = context;
  const is = (one: Slot | undefined) => one?.lane === slot.lane && one.index === slot.index;
  const add = (step: Step) => {
    store.change(with_inserted(store.root.value, slot, step));
    set_adding(undefined);
    store.chosen.value = step.id;
    if (step.kind === 'parallel') go_to(step.id); // its branches are filled in the drawing
    else open_form();
  };
  const name = joined('sequence-slot', is(drag.over) && 'sequence-target', is_empty && 'sequence-empty');
  return (
    <div class={name} data-slot={`${slot.lane} ${slot.index}`}>
      {is(adding) ? (
        <Choices close={() => set_adding(undefined)}>
          <Button small icon="clock" onClick={() => add(new_wait())}>
            {texts.wait()}
          </Button>
          {/* Under the pointer that opened the menu. */}
          <Button small look="primary" icon="components" onClick={() => add(new_command())}>
            {texts.command()}
          </Button>
          <Button small icon="sequence" onClick={() => add(new_parallel())}>
            {texts.parallel()}
          </Button>
        </Choices>
      ) : (
        <IconButton
          small
          class="sequence-add"
          icon="plus"
          label={texts.add_here()}
          tabIndex={is_empty ? 0 : -1}
          onClick={() => set_adding(slot)}
        />
      )}
    </div>
  );
}

// Takes the focus. Escape or leaving closes it.
function Choices({ close, children }: { close: () => void; children: ComponentChildren }) {
  const box = useRef<HTMLDivElement>(null);
  useLayoutEffect(() => box.current?.querySelector<HTMLElement>('.button-primary')?.focus(), []);
  const left = (event: FocusEvent) => {
    if (!box.current?.contains(event.relatedTarget as Node | null)) close();
  };
  return (
    <div
      ref={box}
      class="sequence-choices"
      role="group"
      aria-label={texts.add()}
      onFocusOut={left}
      onKeyDown={(event) => event.key === 'Escape' && close()}
    >
      {children}
    </div>
  );
}
