import { useSignal } from '@preact/signals';
import type { ComponentChildren } from 'preact';

import { useConsole } from '../context';
import { language, type Language, languages } from '../i18n/i18n';
import { Button } from '../ui/button';
import { Dialog } from '../ui/dialog';
import { tried } from '../ui/error_text';
import { StopButton } from '../ui/stop_button';
import { Pop } from '../ui/pop';
import { is_narrow } from './navigation';
import { LinkMark } from './link_status';
import { NoticeArea } from './notices';
import * as texts from './texts';
import { theme, type Theme } from './theme';

export function Header() {
  const console = useConsole();
  const asks = useSignal(false);
  const name = console.profile.profile.value?.engine.name;
  return (
    <header class="head">
      <a class="skip" href="#panels">
        {texts.skip()}
      </a>
      <h1>
        RoIS {name && <span class="head-engine">{name}</span>}
      </h1>
      <LinkMark />
      <NoticeArea />
      <StopButton />
      <Menu>
        <Bound />
        <label class="head-choice">
          <span class="unseen">{texts.theme()}</span>
          <select value={theme.value} title={texts.theme()} onChange={(event) => choose_theme(event.currentTarget.value as Theme)}>
            <option value="system">{texts.theme_system()}</option>
            <option value="dark">{texts.theme_dark()}</option>
            <option value="light">{texts.theme_light()}</option>
          </select>
        </label>
        <label class="head-choice">
          <span class="unseen">{texts.language()}</span>
          <select
            value={language.value}
            title={texts.language()}
            onChange={(event) => choose_language(event.currentTarget.value as Language)}
          >
            {languages.map((one) => (
              <option key={one.code} value={one.code} lang={one.code}>
                {one.name}
              </option>
            ))}
          </select>
        </label>
        {console.link.is_open && (
          <Button small look="quiet" onClick={ask_or_disconnect}>
            {texts.disconnect()}
          </Button>
        )}
        <Dialog
          title={texts.disconnect_title()}
          open={asks.value}
          close={() => (asks.value = false)}
          actions={
            <>
              <Button look="danger" onClick={disconnect}>{texts.disconnect()}</Button>
              <Button onClick={() => (asks.value = false)}>{texts.cancel()}</Button>
            </>
          }
        >
          <p>{texts.disconnect_hint(console.bindings.mine.value.size, console.commands.open().length)}</p>
        </Dialog>
      </Menu>
    </header>
  );

  function ask_or_disconnect(): void {
    if (console.bindings.mine.value.size > 0 || console.commands.open().length > 0) asks.value = true;
    else void console.close();
  }
  function disconnect(): void {
    asks.value = false;
    void console.close();
  }
  function choose_theme(chosen: Theme): void {
    theme.value = chosen;
    console.environment.remember('theme', chosen);
  }
  function choose_language(chosen: Language): void {
    language.value = chosen;
    console.environment.remember('language', chosen);
  }
}

// A row if there is room, else a menu.
function Menu({ children }: { children: ComponentChildren }) {
  const content = <div class="head-end">{children}</div>;
  return is_narrow.value ? <Pop label={texts.menu()} at_right>{content}</Pop> : content;
}

// Lists the components that this console has bound, because other sessions cannot use them.
function Bound() {
  const console = useConsole();
  const { bindings } = console;
  const is_open = useSignal(false);
  const mine = [...bindings.mine.value].sort();
  return (
    <>
      <Button small look="quiet" icon="link" title={texts.bound_title()} onClick={() => (is_open.value = true)}>
        {texts.bound(mine.length)}
      </Button>
      <Dialog
        title={texts.bound_title()}
        open={is_open.value}
        close={() => (is_open.value = false)}
        actions={
          mine.length > 0 && (
            <Button look="danger" onClick={() => tried(console, '', bindings.release_all())}>
              {texts.release_all()}
            </Button>
          )
        }
      >
        {mine.length === 0 ? <p>{texts.none_bound()}</p> : <p>{texts.release_hint()}</p>}
        <ul class="plain-list">
          {mine.map((ref) => (
            <li key={ref} class="row-spread">
              <code>{ref}</code>
              <Button small onClick={() => tried(console, ref, bindings.release(ref))} aria-label={`${texts.release()}: ${ref}`}>
                {texts.release()}
              </Button>
            </li>
          ))}
        </ul>
      </Dialog>
    </>
  );
}
