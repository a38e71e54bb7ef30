// The Time line panel: lanes for the link, commands, events and each component.
import './timeline.css';

import { useSignal } from '@preact/signals';
import { useRef } from 'preact/hooks';

import { useConsole } from '../context';
import * as panel_titles from '../shell/panel_titles';
import { Chart } from './chart';
import { DetailsPane } from './details';
import { Listing } from './listing';
import { opened_by, type Thing } from './things';
import { Toolbar } from './toolbar';
import { view_of } from './view';

export default function TimelinePanel() {
  const console = useConsole();
  const view = view_of(console);
  const opened = useSignal<Thing | undefined>(undefined);
  const as_table = useSignal(console.environment.recall('timeline.as_table') === 'true');
  const opener = useRef<HTMLElement | null>(null);
  const open = (thing: Thing) => {
    if (!opened.peek()) opener.current = document.activeElement as HTMLElement | null;
    opened.value = opened_by(thing);
  };
  const close = () => {
    opened.value = undefined;
    opener.current?.focus();
  };
  const choose_table = (is_chosen: boolean) => {
    as_table.value = is_chosen;
    console.environment.remember('timeline.as_table', String(is_chosen));
  };
  return (
    <div class="timeline">
      <h2 class="unseen">{panel_titles.timeline()}</h2>
      <Toolbar view={view} as_table={as_table.value} choose_table={choose_table} />
      <div class="timeline-body">
        {as_table.value ? <Listing view={view} open={open} /> : <Chart view={view} opened={opened.value} open={open} />}
        {opened.value && <DetailsPane view={view} thing={opened.value} open={open} close={close} />}
      </div>
    </div>
  );
}
