// The panels of the page. A line here adds a panel to the navigation; docs/console.md says what a panel needs.
import type { Panel } from './shell/navigation';
import * as panel_titles from './shell/panel_titles';

export const panels: readonly Panel[] = [
  { id: 'map', title: panel_titles.map, icon: 'map', area: 'main', load: () => import('./map/panel') },
  { id: 'sequence', title: panel_titles.sequence, icon: 'sequence', area: 'main', load: () => import('./sequence/panel') },
  { id: 'conditions', title: panel_titles.conditions, icon: 'conditions', area: 'main', load: () => import('./conditions/panel') },
  { id: 'scenario', title: panel_titles.scenario, icon: 'scenario', area: 'main', load: () => import('./scenario/panel') },
  { id: 'timeline', title: panel_titles.timeline, icon: 'timeline', area: 'below', load: () => import('./timeline/panel') },
  { id: 'messages', title: panel_titles.messages, icon: 'messages', area: 'below', load: () => import('./messages/panel') },
  { id: 'components', title: panel_titles.components, icon: 'components', area: 'side', load: () => import('./components/panel') },
  { id: 'visitors', title: panel_titles.visitors, icon: 'person', area: 'side', load: () => import('./visitors/panel') },
  { id: 'health', title: panel_titles.health, icon: 'health', area: 'side', load: () => import('./health/panel') },
];
