// The panels of the page. A line here puts a panel into the navigation; docs/console.md says what it has to bring.
import type { ComponentType } from 'preact';

import type { IconName } from './ui/icon';
// Not by name, but so that those that are alike stand together: the page is smaller so (docs/console.md).
import ScenarioPanel from './scenario/panel';
import * as scenario from './scenario/texts';
import SequencePanel from './sequence/panel';
import * as sequence from './sequence/texts';
import ConditionsPanel from './conditions/panel';
import * as conditions from './conditions/texts';
import ComponentsPanel from './components/panel';
import * as components from './components/texts';
import MessagesPanel from './messages/panel';
import * as messages from './messages/texts';
import HealthPanel from './health/panel';
import * as health from './health/texts';
import TimelinePanel from './timeline/panel';
import * as timeline from './timeline/texts';
import MapPanel from './map/panel';
import * as map from './map/texts';
import VisitorsPanel from './visitors/panel';
import * as visitors from './visitors/texts';

/** Where a panel stands on a wide screen: the big one, the strip below it, or the column beside both. */
export type Area = 'main' | 'below' | 'side';

export interface Panel {
  /** In addresses (`#components`) and in what is remembered. */
  id: string;
  title: () => string;
  icon: IconName;
  area: Area;
  Content: ComponentType;
}

export const panels: readonly Panel[] = [
  { id: 'map', title: map.title, icon: 'map', area: 'main', Content: MapPanel },
  { id: 'sequence', title: sequence.title, icon: 'sequence', area: 'main', Content: SequencePanel },
  { id: 'conditions', title: conditions.title, icon: 'conditions', area: 'main', Content: ConditionsPanel },
  { id: 'scenario', title: scenario.title, icon: 'scenario', area: 'main', Content: ScenarioPanel },
  { id: 'timeline', title: timeline.title, icon: 'timeline', area: 'below', Content: TimelinePanel },
  { id: 'messages', title: messages.title, icon: 'messages', area: 'below', Content: MessagesPanel },
  { id: 'components', title: components.title, icon: 'components', area: 'side', Content: ComponentsPanel },
  { id: 'visitors', title: visitors.title, icon: 'person', area: 'side', Content: VisitorsPanel },
  { id: 'health', title: health.title, icon: 'health', area: 'side', Content: HealthPanel },
];
