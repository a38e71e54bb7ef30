// Banners for "everything is stopped" and for held robots.
import { useSignal } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';

import { useConsole } from '../context';
import { Button } from '../ui/button';
import { Dialog } from '../ui/dialog';
import { tried } from '../ui/error_text';
import * as texts from './texts';

export function StoppedBanner() {
  const console = useConsole();
  const { everything } = console;
  const asks = useSignal(false);
  const { stopped, waiting } = everything.view.value;
  const clear = () => {
    asks.value = false;
    tried(console, 'clear', everything.clear());
  };
  return (
    <>
      {stopped && (
        <p class="banner banner-stopped" role="alert">
          <strong>{texts.stopped()}</strong> {texts.stopped_hint()}{' '}
          {waiting.length > 0 && <strong>{texts.not_confirmed(waiting.join(', '))}</strong>}
          <Button onClick={() => (asks.value = true)}>{texts.clear()}</Button>
        </p>
      )}
      <Dialog
        title={texts.clear_title()}
        open={asks.value && stopped}
        close={() => (asks.value = false)}
        actions={
          <>
            <Button look="primary" onClick={clear}>{texts.clear()}</Button>
            <Button onClick={() => (asks.value = false)}>{texts.cancel()}</Button>
          </>
        }
      >
        <p>{texts.clear_hint()}</p>
        {waiting.length > 0 && <p>{texts.not_confirmed(waiting.join(', '))}</p>}
      </Dialog>
    </>
  );
}

/** A notice for each hold, with a button to resume if this console may. */
export function Holds() {
  const console = useConsole();
  const { events, notices, bindings } = console;
  const seen = useRef(new Set(events.errors.list().map((one) => one.number)));
  const beat = events.pulse.beat.value;
  useEffect(() => {
    for (const one of events.errors.list()) {
      if (seen.current.has(one.number) || one.details.state !== 'there') continue;
      seen.current.add(one.number);
      const ref = one.error.component_ref?.code;
      const text = one.details.results.text('text') ?? '';
      if (ref === undefined || !text.startsWith('its motion is held')) continue;
      const action = { label: texts.resume(), act: () => tried(console, ref, console.run(ref, 'resume')) };
      notices.show('error', texts.held(ref), { detail: text, about: ref, ...(bindings.mine.value.has(ref) && { action }) });
    }
  }, [beat]);
  return null;
}
