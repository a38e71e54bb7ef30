// The panels of the page. A line here puts a panel into the navigation; docs/console.md says what it has to bring.
import type { ComponentType } from 'preact';

import { texts as components } from './components/texts';
import { texts as conditions } from './conditions/texts';
import { texts as health } from './health/texts';
import { texts as map } from './map/texts';
import { texts as messages } from './messages/texts';
import { texts as scenario } from './scenario/texts';
import { texts as sequence } from './sequence/texts';
import { texts as timeline } from './timeline/texts';
import type { IconName } from './ui/icon';
import { texts as visitors } from './visitors/texts';

/** Where a panel stands on a wide screen: the big one, the strip below it, or the column beside both. */
export type Area = 'main' | 'below' | 'side';

export interface Panel {
  /** In addresses (`#components`) and in what is remembered. */
  id: string;
  title: () => string;
  icon: IconName;
  area: Area;
  /** A chunk of its own, fetched when it is first shown. */
  load: () => Promise<{ default: ComponentType }>;
}

export const panels: readonly Panel[] = [
  { id: 'map', title: () => map().title, icon: 'map', area: 'main', load: () => import('./map/panel') },
  { id: 'sequence', title: () => sequence().title, icon: 'sequence', area: 'main', load: () => import('./sequence/panel') },
  { id: 'conditions', title: () => conditions().title, icon: 'conditions', area: 'main', load: () => import('./conditions/panel') },
  { id: 'scenario', title: () => scenario().title, icon: 'scenario', area: 'main', load: () => import('./scenario/panel') },
  { id: 'timeline', title: () => timeline().title, icon: 'timeline', area: 'below', load: () => import('./timeline/panel') },
  { id: 'messages', title: () => messages().title, icon: 'messages', area: 'below', load: () => import('./messages/panel') },
  { id: 'components', title: () => components().title, icon: 'components', area: 'side', load: () => import('./components/panel') },
  { id: 'visitors', title: () => visitors().title, icon: 'person', area: 'side', load: () => import('./visitors/panel') },
  { id: 'health', title: () => health().title, icon: 'health', area: 'side', load: () => import('./health/panel') },
];
