// The tree of engines and components, following the ARIA tree pattern: one Tab stop, arrow keys inside.
import { useEffect, useRef, useState } from 'preact/hooks';

import { useConsole } from '../context';
import { shown_description } from '../forms';
import type { ComponentView, EngineView } from '../state/engine/profile_state';
import { Icon, StatusBadge } from '../ui';
import { holder_text } from './holder';
import * as texts from './texts';
import { Work } from './work';

export function Tree({ engine }: { engine: EngineView }) {
  const { selection } = useConsole();
  const root = useRef<HTMLUListElement>(null);
  const [closed, set_closed] = useState<ReadonlySet<string>>(new Set());
  const toggle = (name: string, to_closed = !closed.has(name)) => {
    const others = [...closed].filter((one) => one !== name);
    set_closed(new Set(to_closed ? [...others, name] : others));
  };
  const [focused, set_focused] = useState('');
  const chosen = selection.component.value;
  // The list may have become shorter.
  useEffect(() => root.current!.querySelector('[aria-selected=true]')?.scrollIntoView({ block: 'nearest' }), [chosen]);
  const at = focused !== '' ? focused : chosen !== '' ? `component ${chosen}` : `engine ${engine.name}`;

  const pressed = (event: KeyboardEvent) => {
    const items = [...root.current!.querySelectorAll<HTMLElement>('[role=treeitem]')];
    const item = (event.target as HTMLElement).closest<HTMLElement>('[role=treeitem]');
    if (!item) return;
    const i = items.indexOf(item);
    const name = item.dataset['engine'];
    const go = (to: HTMLElement | undefined) => to?.focus();
    const act = {
      ArrowDown: () => go(items[i + 1]),
      ArrowUp: () => go(items[i - 1]),
      Home: () => go(items[0]),
      End: () => go(items.at(-1)),
      ArrowRight: () => (name === undefined ? undefined : closed.has(name) ? toggle(name, false) : go(items[i + 1])),
      ArrowLeft: () =>
        name !== undefined && !closed.has(name)
          ? toggle(name, true)
          : go(item.parentElement?.closest<HTMLElement>('[role=treeitem]') ?? undefined),
      Enter: () => item.click(),
      ' ': () => item.click(),
    }[event.key];
    if (!act) return;
    event.preventDefault();
    event.stopPropagation();
    act();
  };
  const focus = (event: FocusEvent) => set_focused((event.target as HTMLElement).dataset['item'] ?? '');

  return (
    <div class="engine-frame">
      <ul class="engine-tree" role="tree" aria-label={texts.tree()} ref={root} onKeyDown={pressed} onFocusIn={focus}>
        <Engine engine={engine} at={at} closed={closed} toggle={toggle} />
      </ul>
    </div>
  );
}

interface EngineProps {
  engine: EngineView;
  at: string; // the item with the Tab stop
  closed: ReadonlySet<string>;
  toggle: (name: string) => void;
}

function Engine({ engine, at, closed, toggle }: EngineProps) {
  const item = `engine ${engine.name}`;
  const is_open = !closed.has(engine.name);
  const clicked = (event: Event) => {
    event.stopPropagation();
    toggle(engine.name);
  };
  return (
    <li
      role="treeitem"
      aria-expanded={is_open}
      aria-label={engine.name}
      tabIndex={at === item ? 0 : -1}
      data-item={item}
      data-engine={engine.name}
      onClick={clicked}
    >
      <span class="engine-name" title={engine.identifier}>
        <Icon name={is_open ? 'down' : 'right'} size={12} />
        {engine.name}
      </span>
      {is_open && (
        <ul role="group">
          {engine.components.map((one) => <Row key={one.ref} component={one} is_stop={at === `component ${one.ref}`} />)}
          {engine.sub_engines.map((one) => <Engine key={one.name} engine={one} at={at} closed={closed} toggle={toggle} />)}
        </ul>
      )}
    </li>
  );
}

function Row({ component, is_stop }: { component: ComponentView; is_stop: boolean }) {
  const console = useConsole();
  const { status, selection } = console;
  const entry = status.of(component.ref);
  const holder = holder_text(console, component.ref);
  const is_chosen = selection.component.value === component.ref;
  const choose = (event: Event) => {
    event.stopPropagation();
    selection.component.value = component.ref;
  };
  return (
    <li
      role="treeitem"
      class="engine-component"
      title={shown_description(component.description)}
      aria-selected={is_chosen}
      tabIndex={is_stop ? 0 : -1}
      data-item={`component ${component.ref}`}
      onClick={choose}
    >
      <span class="engine-ref">{component.ref}</span>
      <span class="engine-type">{component.type_name}</span>
      <Work component={component.ref} />
      {holder !== '' && <span class="engine-holder">{holder}</span>}
      {entry ? <StatusBadge status={entry.status} title={entry.trouble} /> : <span class="engine-holder">{texts.unasked()}</span>}
    </li>
  );
}
