import { useEffect } from 'preact/hooks';

import { ConsoleContext, useConsole, useWatch } from '../context';
import { language } from '../i18n/i18n';
import type { Console } from '../state/console';
import { Header } from './header';
import { Layout } from './layout';
import { LinkBanner } from './link_status';
import { Holds, StoppedBanner } from './stopped';
import * as texts from './texts';
import { TokenDialog } from './token_dialog';

export function App({ console }: { console: Console }) {
  useEffect(() => {
    document.documentElement.lang = language.value;
    document.title = texts.title();
  }, [language.value]);
  const { phase } = console.link.view.value;
  const is_stale = console.link.received_at > 0 && /^(lost|draining|refused|closed)$/.test(phase);
  return (
    <ConsoleContext.Provider value={console}>
      <div class="app">
        <Header />
        <StoppedBanner />
        <LinkBanner />
        <main id="panels" class={is_stale ? 'app-main app-stale' : 'app-main'} tabIndex={-1}>
          <Layout />
        </main>
        <TokenDialog />
        <Watch />
        <Holds />
      </div>
    </ConsoleContext.Provider>
  );
}

// Watches persons and robots from the start: events report only changes, so a late subscriber would miss persons who stand still. It also
// keeps trails without gaps.
function Watch() {
  const { entities, robots } = useConsole();
  useWatch(entities);
  useWatch(robots.poll);
  return null;
}
