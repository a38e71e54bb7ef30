// The Health panel: numbers, plots of the last minute, sessions, limits and errors.
import './health.css';

import { untracked } from '@preact/signals';

import { useConsole, useWatch } from '../context';
import * as panel_titles from '../shell/panel_titles';
import { Figures } from './figures';
import { ErrorLog } from './error_log';
import { Plots } from './plots';
import { Limits, Sessions, Troubles } from './tables';
import * as texts from './texts';

export default function HealthPanel() {
  const { metrics, traffic, now } = useConsole();
  useWatch(metrics.poll);
  useWatch(traffic.ping);
  const at = now.value;
  // Once a second, not with each answer.
  const is_stale = untracked(() => metrics.is_stale(at));
  return (
    <div class={is_stale ? 'health health-stale' : 'health'} role="region" aria-label={texts.all()} tabIndex={0}>
      <h2 class="unseen">{panel_titles.health()}</h2>
      <Figures />
      <Plots />
      <div class="health-tables">
        <Sessions />
        <Limits />
        <Troubles />
        <ErrorLog />
      </div>
    </div>
  );
}
