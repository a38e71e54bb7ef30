// Live state of a command: waiting, running since, how it ended and why.
import './forms.css';

import { useEffect } from 'preact/hooks';

import { useConsole } from '../context';
import { duration } from '../i18n/i18n';
import { type CommandEntry, has_ended } from '../state/session/commands_state';
import { Button, StatusBadge, tried } from '../ui';
import * as texts from './exchange_texts';
import { why } from './why';

export function CommandProgress({ entry }: { entry: CommandEntry }) {
  const console = useConsole();
  void console.commands.pulse.beat.value;
  const ended = has_ended(entry);
  const now = ended ? entry.ended_at! : console.time();
  const title = `${entry.component} ${entry.command_type}`;
  const has_results =
    (console.profile.component(entry.component)?.commands.find((one) => one.name === entry.command_type)?.results.length ?? 0) > 0;
  useEffect(() => {
    if (entry.state === 'OK' && has_results) void console.commands.fetch_results(entry);
  }, [entry.state, has_results]);
  const can_stop = !ended && entry.command_type === 'start';
  const stop = () => tried(console, entry.component, console.run(entry.component, 'stop', {}, { give_back: true }));
  return (
    <div class="command-progress">
      <p class="exchange-line">
        <StatusBadge status={entry.state} />
        <span>{texts.ended(entry.state)}</span>
        <span class="soft">{(ended ? texts.lasted : texts.lasts)(duration(Math.max(0, now - (entry.started_at ?? entry.sent_at))))}</span>
        {can_stop && (
          <Button small look="danger" icon="stop" aria-label={texts.stop_it(title)} onClick={stop}>
            {texts.stop()}
          </Button>
        )}
      </p>
      {why(console, entry).map((text) => <p key={text} class="exchange-why">{text}</p>)}
    </div>
  );
}
