// Buttons for the sequence and the selected step.
import { useConsole } from '../context';
import { Button, IconButton, tried } from '../ui';
import { move } from './keys';
import { copy_of, found, slot_towards, type Slot, with_inserted, without } from './model';
import type { SequenceStore } from './store';
import * as texts from './texts';

export interface ToolbarProps {
  store: SequenceStore;
  set_adding: (slot: Slot | undefined) => void;
  open_library: () => void;
}

export function Toolbar({ store, set_adding, open_library }: ToolbarProps) {
  const console = useConsole();
  const root = store.root.value;
  const at = found(root, store.chosen.value);
  const run = () => {
    const [problem] = store.problems.value;
    store.is_strict.value = problem !== undefined;
    if (problem) store.chosen.value = problem.step;
    else void store.execute().catch(() => undefined); // shown by the drawing
  };
  const stop = () => tried(console, 'sequence', store.stop());
  const add = () => set_adding({ lane: at?.lane.id ?? root.id, index: at ? at.slot.index + 1 : root.steps.length });
  const can_move = (direction: 'earlier' | 'later' | 'up' | 'down') =>
    at !== undefined && slot_towards(root, at.step.id, direction) !== undefined;
  const tool = (icon: 'left' | 'right' | 'up' | 'down', label: string, direction: 'earlier' | 'later' | 'up' | 'down') => (
    <IconButton icon={icon} label={label} disabled={!can_move(direction)} onClick={() => at && move(store, at.step.id, direction)} />
  );
  return (
    <div class="sequence-toolbar" role="group" aria-label={texts.tools()}>
      <Button
        look="primary"
        icon="play"
        disabled={store.is_empty || store.is_running || store.still_queued.length > 0 || !console.link.is_open}
        onClick={run}
      >
        {texts.run()}
      </Button>
      <Button look="danger" icon="stop" disabled={!store.is_running} onClick={stop}>
        {texts.stop()}
      </Button>
      <span class="sequence-gap" />
      <Button icon="plus" onClick={add}>
        {texts.add()}
      </Button>
      <IconButton
        icon="copy"
        label={texts.duplicate()}
        disabled={!at}
        onClick={() => at && store.change(with_inserted(root, { ...at.slot, index: at.slot.index + 1 }, copy_of(at.step)))}
      />
      {tool('left', texts.earlier(), 'earlier')}
      {tool('right', texts.later(), 'later')}
      {tool('up', texts.up(), 'up')}
      {tool('down', texts.down(), 'down')}
      <IconButton icon="close" label={texts.remove()} disabled={!at} onClick={() => at && store.change(without(root, at.step.id))} />
      <IconButton icon="undo" label={texts.undo()} disabled={!store.can_undo.value} onClick={() => store.undo()} />
      <span class="sequence-fill" />
      <span class="sequence-name">{store.name.value || texts.unnamed()}</span>
      <Button icon="download" onClick={open_library}>
        {texts.sequences()}
      </Button>
    </div>
  );
}
