// The sequence drawn as in annex B: boxes in a row, and branches between two bars.
import { useEffect, useRef } from 'preact/hooks';

import { useConsole } from '../context';
import { IconButton } from '../ui';
import { useDrag } from './drag';
import { step_key } from './keys';
import type { LaneContext } from './lane_context';
import { found, type Lane, type ParallelStep, type Slot, type Step, with_branch, with_moved } from './model';
import { run_view, type RunView } from './running';
import { SlotView } from './slot_view';
import { CommandBox, ParallelHead, WaitBox } from './step_box';
import type { SequenceStore } from './store';
import * as texts from './texts';

export interface DrawingProps {
  store: SequenceStore;
  /** The place where a step is being added, if any. */
  adding: Slot | undefined;
  set_adding: (slot: Slot | undefined) => void;
  open_form: () => void;
}

export function Drawing({ store, adding, set_adding, open_form }: DrawingProps) {
  const console = useConsole();
  const frame = useRef<HTMLDivElement>(null);
  const root = store.root.value;
  const run = store.run.value;
  void console.commands.pulse.beat.value;
  const view: RunView = run ? run_view(run.root, run.entries, run.sent_at, run.entries.size > 0 ? console.time() : 0) : new Map();
  const go_to = (id: number) => {
    store.chosen.value = id;
    requestAnimationFrame(() => frame.current?.querySelector<HTMLElement>(`[data-step="${id}"]`)?.focus());
  };
  const drag = useDrag((id, to) => store.change(with_moved(store.root.value, id, to)));
  const pressed = (event: KeyboardEvent) => {
    if (!(event.target as HTMLElement).dataset['step']) return;
    const at = found(root, store.chosen.value)?.slot;
    const add = () => set_adding({ lane: at?.lane ?? root.id, index: at ? at.index + 1 : root.steps.length });
    if (!step_key(event, store, { go_to, add, open: open_form })) return;
    event.preventDefault();
    if (event.altKey) go_to(store.chosen.value);
  };
  // Scrolls to the running step unless the focus is in the drawing.
  const running = [...view].find(([, one]) => one.state === 'running')?.[0];
  useEffect(() => {
    if (running !== undefined && !frame.current?.contains(document.activeElement))
      frame.current?.querySelector(`[data-step="${running}"]`)?.scrollIntoView({ block: 'nearest', inline: 'nearest' });
  }, [running]);
  const first = store.chosen.value !== 0 && found(root, store.chosen.value) ? store.chosen.value : root.steps[0]?.id;
  const context: LaneContext = { store, view, adding, set_adding, drag, first, go_to, open_form };
  return (
    <div
      ref={frame}
      class={drag.dragged ? 'sequence-drawing sequence-dragging' : 'sequence-drawing'}
      role="group"
      aria-label={texts.drawing()}
      onKeyDown={pressed}
    >
      <div class="sequence-whole">
        <span class="sequence-begin" aria-hidden="true" />
        <LaneView lane={root} label={texts.steps()} context={context} />
        <span class="sequence-end" aria-hidden="true" />
      </div>
    </div>
  );
}

function LaneView({ lane, label, context }: { lane: Lane; label: string; context: LaneContext }) {
  return (
    <ol class="sequence-lane" aria-label={label}>
      {lane.steps.map((step, index) => (
        <li key={step.id} class="sequence-item">
          <SlotView slot={{ lane: lane.id, index }} context={context} />
          <StepView step={step} context={context} />
        </li>
      ))}
      <li class="sequence-item sequence-last">
        <SlotView slot={{ lane: lane.id, index: lane.steps.length }} context={context} is_empty={lane.steps.length === 0} />
      </li>
    </ol>
  );
}

function StepView({ step, context }: { step: Step; context: LaneContext }) {
  switch (step.kind) {
    case 'command':
      return <CommandBox step={step} context={context} />;
    case 'wait':
      return <WaitBox step={step} context={context} />;
    case 'parallel':
      return <ParallelView step={step} context={context} />;
  }
}

function ParallelView({ step, context }: { step: ParallelStep; context: LaneContext }) {
  const { store } = context;
  return (
    <div class="sequence-parallel">
      <ParallelHead step={step} context={context} />
      <ul class="sequence-branches">
        {step.branches.map((one, i) => (
          <li key={one.id} class="sequence-branch">
            <LaneView lane={one} label={texts.branch(i + 1)} context={context} />
          </li>
        ))}
      </ul>
      <IconButton
        small
        class="sequence-add-branch"
        icon="plus"
        label={texts.add_branch()}
        tabIndex={-1}
        onClick={() => store.change(with_branch(store.root.value, step.id))}
      />
    </div>
  );
}
