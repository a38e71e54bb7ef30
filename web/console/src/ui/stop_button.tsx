// Stops everything with one press. It is in the header and in every dialog, because a dialog blocks the page.
import { useConsole } from '../context';
import { Button } from './button';
import * as t from './texts';

export function StopButton() {
  const { everything } = useConsole();
  const trouble = everything.trouble.value;
  return (
    <span class="stop-all">
      <Button look="danger" icon="stop" title={t.stop_all_title()} aria-label={t.stop_all_title()} onClick={() => void everything.stop()}>
        {t.stop_all()}
      </Button>
      {trouble !== '' && (
        <strong class="stop-trouble" role="alert">
          {t.not_stopped(trouble)}
        </strong>
      )}
    </span>
  );
}
