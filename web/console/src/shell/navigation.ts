// The shown panel of each area, and links between panels.
import { type Signal, signal } from '@preact/signals';
import type { ComponentType } from 'preact';

import type { Console } from '../state/console';
import type { IconName } from '../ui/icon';

/** The area of a panel on a wide screen: the large one, the strip below, or the column beside both. */
export type Area = 'main' | 'below' | 'side';

export interface Panel {
  /** Used in addresses (`#components`) and stored settings. */
  id: string;
  title: () => string;
  icon: IconName;
  area: Area;
  /** Fetches the panel's code. Called when the panel is first shown. */
  load: () => Promise<{ default: ComponentType }>;
}

/** Whether the screen has room for all three areas. */
export const is_wide = signal(true);
/** Whether the header collapses to a menu. */
export const is_narrow = signal(false);
/** The id of the shown panel of each area, and of `all` on a narrow screen. */
export const shown = signal<Readonly<Record<Area | 'all', string>>>({ main: '', below: '', side: '', all: '' });

let panels: readonly Panel[] = [];

/** The panels of an area, in order. */
export function panels_of(area: Area | 'all'): readonly Panel[] {
  return area === 'all' ? panels : panels.filter((one) => one.area === area);
}

/** The shown panel of an area, initially the first one. */
export function in_front(area: Area | 'all'): Panel | undefined {
  const all = panels_of(area);
  return all.find((one) => one.id === shown.value[area]) ?? all[0];
}

/** Shows a panel in its area. */
export function show_panel(id: string): void {
  const panel = panels.find((one) => one.id === id);
  if (!panel) return;
  shown.value = { ...shown.value, [panel.area]: id, all: id };
  history.replaceState(null, '', `#${id}`);
}

/** Shows a component in the Components panel. */
export function show_component({ selection }: Console, ref: string): void {
  selection.component.value = ref;
  show_panel('components');
}

/** Shows a document in the Messages panel. */
export function show_document({ selection }: Console, number: number): void {
  selection.wanted.value = number;
  show_panel('messages');
}

/** Shows only the events of a subscription. */
export function show_events({ selection }: Console, subscribe_id: string): void {
  selection.subscription.value = subscribe_id;
  show_panel('messages');
}

/** Starts with these panels, shows the recalled ones, and follows the window's width and the address. */
export function begin_layout(all: readonly Panel[], recalled: string | undefined): void {
  panels = all;
  follow('(min-width: 1100px)', is_wide);
  follow('(max-width: 1099px)', is_narrow);
  const from_address = () => show_panel(location.hash.slice(1));
  addEventListener('hashchange', from_address);
  for (const id of (recalled ?? '').split(' ')) {
    const panel = panels.find((one) => one.id === id);
    if (panel) shown.value = { ...shown.value, [panel.area]: id, all: id };
  }
  from_address();
  // Fetches the code while the page is rendered, not after.
  for (const area of is_wide.value ? areas : (['all'] as const)) in_front(area)?.load().catch(() => undefined);
}

export const areas: readonly Area[] = ['main', 'below', 'side'];

function follow(query: string, answer: Signal<boolean>): void {
  const list = matchMedia(query);
  const read = () => (answer.value = list.matches);
  list.addEventListener('change', read);
  read();
}
