// Buttons to choose a command, query or event.
import { signature } from '../forms';
import type { Offered } from '../state/engine/profile_state';

export interface PickProps {
  label: string;
  names: readonly string[];
  /** The messages with these names. A name without a message has no tooltip. */
  offered: readonly Offered[];
  chosen: string;
  choose: (name: string) => void;
}

export function Pick({ label, names, offered, chosen, choose }: PickProps) {
  const tooltip = (name: string) => {
    const found = offered.find((one) => one.name === name);
    return found && signature(found);
  };
  return (
    <div class="component-pick" role="group" aria-label={label}>
      {names.map((name) => (
        <button
          key={name}
          type="button"
          class="button button-small component-choice"
          aria-pressed={name === chosen}
          title={tooltip(name)}
          onClick={() => choose(name)}
        >
          {name}
        </button>
      ))}
    </div>
  );
}
