// Shows that this console has started a component. Its status is READY meanwhile (RoIS: ready to be used).
import { useConsole } from '../context';
import { Badge } from '../ui';
import * as t from './texts';

export function Work({ component }: { component: string }) {
  const { commands } = useConsole();
  void commands.pulse.beat.value;
  const running = commands.running_on(component).at(-1);
  if (!running && !commands.goes_on(component)) return null;
  return (
    <Badge tone="busy" title={running ? t.runs(running.command_type) : t.goes_on()}>
      {t.running()}
    </Badge>
  );
}
