import './ui/styles/tokens.css';
import './ui/styles/base.css';
import './ui/styles/widgets.css';
import './shell/shell.css';

import { render } from 'preact';

import { type Language, language, wished_language } from './i18n/i18n';
import { panels } from './panels';
import { App } from './shell/app';
import { browser, visit } from './shell/environment';
import { begin_layout } from './shell/navigation';
import { follow_system, type Theme, theme } from './shell/theme';
import { Console } from './state/console';
import { keep, restore } from './state/keeping';

theme.value = (browser.recall('theme') as Theme | undefined) ?? 'system';
language.value = (browser.recall('language') as Language | undefined) ?? wished_language(navigator.languages);
follow_system();
begin_layout(panels, browser.recall('panels'));

const state = new Console(browser);
restore(state, visit.recall());
state.connect();
state.history.record();
// For developer tools and tests: `rois.run('navigation', 'start', { target_position: ['desk'] })`.
Object.assign(window, { rois: state });
// Asks before closing the page: its commands would be stopped.
addEventListener('beforeunload', (event) => {
  if (state.commands.open().length > 0 || state.runs_scenario.value) event.preventDefault();
});
addEventListener('pagehide', () => {
  keep(state, visit.remember);
  void state.close();
});
addEventListener('pageshow', (event) => {
  if (event.persisted) state.connect(state.current_token);
});

render(<App console={state} />, document.getElementById('console')!);
