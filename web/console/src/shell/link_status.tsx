// Link state: a badge in the header and, if needed, a banner.
import { useConsole } from '../context';
import { Badge, tone_of } from '../ui/states';
import { Button } from '../ui/button';
import * as texts from './texts';

const stale_after = 5000; // ms; the console sends a request every second

export function LinkMark() {
  const { link, now } = useConsole();
  const { phase, reason } = link.view.value;
  const age = now.value - link.received_at;
  return (
    <div class="link-mark">
      <Badge tone={link.is_open && age > stale_after ? 'warning' : tone_of(phase)} title={reason}>
        {texts.phase(phase)}
      </Badge>
      {link.received_at > 0 && <span class="link-age">{texts.age(Math.max(0, age))}</span>}
    </div>
  );
}

export function LinkBanner() {
  const console = useConsole();
  const { phase, reason, since } = console.link.view.value;
  const missed = console.link.missed.value;
  const received_at = console.link.received_at;
  // A quick reconnect should not flash a banner.
  const is_long = console.now.value - since > 1500;
  const sentence = () => {
    if (phase === 'lost') return `${texts.is_old(console.now.value - received_at)} ${texts.lost_hint()}`;
    if (phase === 'draining')
      return received_at > 0 ? `${texts.draining_hint()} ${texts.is_old(console.now.value - received_at)}` : texts.draining_hint();
    if (phase === 'connecting') return is_long ? texts.connecting_hint() : '';
    return { refused: texts.refused_hint(), closed: texts.closed_hint() }[phase as string] ?? '';
  };
  const text = sentence();
  return (
    <div class="banners" role="status" aria-live="polite">
      {text !== '' && (
        <p class={`banner banner-${tone_of(phase)}`}>
          <strong>{texts.phase(phase)}.</strong> {text} {reason !== '' && phase !== 'closed' && <code>{reason}</code>}
          {/^(connecting|lost|draining|refused)$/.test(phase) && (
            <Button small icon="refresh" onClick={() => console.retry()}>
              {texts.try_now()}
            </Button>
          )}
          {phase === 'closed' && (
            <Button small onClick={() => console.connect(console.current_token)}>
              {texts.connect()}
            </Button>
          )}
        </p>
      )}
      {missed && (
        <p class="banner banner-warning">
          {missed.gap.reason === 'lost' ? texts.missed_lost(missed.gap.count) : texts.missed_session()}
          <Button small onClick={() => console.link.forget_missed()}>
            {texts.seen()}
          </Button>
        </p>
      )}
      {console.profile.is_empty.value && (
        <p class="banner banner-calm">
          <strong>{texts.empty_engine()}.</strong> {texts.empty_engine_hint()}
        </p>
      )}
    </div>
  );
}
