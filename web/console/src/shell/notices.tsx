import { useConsole } from '../context';
import { Button, IconButton } from '../ui/button';
import { Icon, type IconName } from '../ui/icon';
import * as ui from '../ui/texts';
import type { Severity } from '../state/notices';
import * as texts from './texts';

const signs: Record<Severity, IconName> = { info: 'info', good: 'check', warning: 'warning', error: 'warning' };

/** Notices at the edge of the page. Screen readers announce errors at once, others when idle. */
export function NoticeArea() {
  const { notices } = useConsole();
  return (
    <section class="notices" aria-label={texts.notices()}>
      {notices.list.value.map((one) => (
        <div key={one.number} class={`notice notice-${one.severity}`} role={one.severity === 'error' ? 'alert' : 'status'}>
          <Icon name={signs[one.severity]} />
          <p class="notice-text">
            {one.text} {one.detail && <span class="soft">{one.detail}</span>}
          </p>
          {one.action && (
            <Button
              small
              onClick={() => {
                one.action?.act();
                notices.dismiss(one.number);
              }}
            >
              {one.action.label}
            </Button>
          )}
          <IconButton small icon="close" label={ui.close()} onClick={() => notices.dismiss(one.number)} />
        </div>
      ))}
    </section>
  );
}
