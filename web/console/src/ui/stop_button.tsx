// Stops everything with one press. It is in the header and in every dialog, because a dialog blocks the page.
import { useConsole } from '../context';
import { Button } from './button';
import * as texts from './texts';

export function StopButton() {
  const { everything } = useConsole();
  const trouble = everything.trouble.value;
  return (
    <span class="stop-all">
      <Button
        look="danger"
        icon="stop"
        title={texts.stop_all_title()}
        aria-label={texts.stop_all_title()}
        onClick={() => void everything.stop()}
      >
        {texts.stop_all()}
      </Button>
      {trouble !== '' && (
        <strong class="stop-trouble" role="alert">
          {texts.not_stopped(trouble)}
        </strong>
      )}
    </span>
  );
}
