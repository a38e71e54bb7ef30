// Tabs following the ARIA pattern: arrows move and select, Home and End go to the ends.
import type { ComponentChildren } from 'preact';
import { useEffect, useId, useRef } from 'preact/hooks';

import { Icon, type IconName } from './icon';

export interface Tab<Id extends string = string> {
  id: Id;
  title: string;
  icon?: IconName;
  /** A number beside the title, such as the new items. */
  badge?: string | undefined;
}

export interface TabsProps<Id extends string> {
  label: string;
  tabs: readonly Tab<Id>[];
  chosen: Id;
  choose: (id: Id) => void;
  /** Content at the end of the row. */
  end?: ComponentChildren;
  children: ComponentChildren;
}

export function Tabs<Id extends string>({ label, tabs, chosen, choose, end, children }: TabsProps<Id>) {
  const id = useId();
  const row = useRef<HTMLDivElement>(null);
  const go = (to: number) => {
    const tab = tabs[(to + tabs.length) % tabs.length];
    if (!tab) return;
    choose(tab.id);
    row.current?.querySelectorAll<HTMLElement>('[role=tab]')[tabs.indexOf(tab)]?.focus();
  };
  useEffect(() => row.current?.querySelector('[aria-selected=true]')?.scrollIntoView({ block: 'nearest', inline: 'nearest' }), [chosen]);
  const pressed = (event: KeyboardEvent) => {
    const at = tabs.findIndex((one) => one.id === chosen);
    const to = { ArrowRight: at + 1, ArrowLeft: at - 1, Home: 0, End: tabs.length - 1 }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    go(to);
  };
  return (
    <div class="tabs">
      <div class="tabs-row">
        <div class="tabs-list" role="tablist" aria-label={label} ref={row} onKeyDown={pressed}>
          {tabs.map((tab) => (
            <button
              key={tab.id}
              type="button"
              role="tab"
              id={`${id}-${tab.id}`}
              class="tab"
              aria-selected={tab.id === chosen}
              aria-controls={tab.id === chosen ? `${id}-panel` : undefined}
              tabIndex={tab.id === chosen ? 0 : -1}
              onClick={() => choose(tab.id)}
            >
              {tab.icon && <Icon name={tab.icon} />}
              <span>{tab.title}</span>
              {tab.badge && <span class="tab-badge">{tab.badge}</span>}
            </button>
          ))}
        </div>
        {end && <div class="tabs-end">{end}</div>}
      </div>
      <div class="tabs-panel" role="tabpanel" id={`${id}-panel`} aria-labelledby={`${id}-${chosen}`} tabIndex={-1}>
        {children}
      </div>
    </div>
  );
}
