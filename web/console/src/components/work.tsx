// Shows that this console has started a component. Its status is READY meanwhile (RoIS: ready to be used).
import { useConsole } from '../context';
import { Badge } from '../ui';
import * as texts from './texts';

export function Work({ component }: { component: string }) {
  const { commands } = useConsole();
  void commands.pulse.beat.value;
  const running = commands.running_on(component).at(-1);
  if (!running && !commands.goes_on(component)) return null;
  return (
    <Badge tone="busy" title={running ? texts.runs(running.command_type) : texts.goes_on()}>
      {texts.running()}
    </Badge>
  );
}
