// Buttons to choose a command, query or event.
export interface PickProps {
  label: string;
  names: readonly string[];
  chosen: string;
  choose: (name: string) => void;
  /** Tooltip of each button. */
  tell?: (name: string) => string | undefined;
}

export function Pick({ label, names, chosen, choose, tell }: PickProps) {
  return (
    <div class="component-pick" role="group" aria-label={label}>
      {names.map((name) => (
        <button key={name} type="button" class="button button-small component-choice" aria-pressed={name === chosen} title={tell?.(name)} onClick={() => choose(name)}>
          {name}
        </button>
      ))}
    </div>
  );
}
