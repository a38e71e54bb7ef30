// The run in one line: its state, and why it failed.
import { useConsole } from '../context';
import { why } from '../forms/why';
import { duration } from '../i18n/i18n';
import { type CommandEntry, has_ended } from '../state/session/commands_state';
import { Badge, Button, error_text, StatusBadge } from '../ui';
import type { Run, SequenceStore } from './store';
import * as texts from './texts';

export function RunSummary({ store }: { store: SequenceStore }) {
  const { commands } = useConsole();
  void commands.pulse.beat.value;
  const run = store.run.value;
  return (
    <div class="sequence-summary" role="status">
      {run && (run.error !== undefined ? <Refused store={store} run={run} /> : <Progress store={store} run={run} />)}
      {store.still_queued.length > 0 && <span class="field-hint">{texts.left_queued(store.still_queued.join(', '))}</span>}
      {!run && store.going_on.length > 0 && <span class="field-hint">{texts.stays_bound(store.going_on.join(', '))}</span>}
    </div>
  );
}

function Refused({ store, run }: { store: SequenceStore; run: Run }) {
  return (
    <>
      <Badge tone="bad">{texts.refused()}</Badge>
      <span>{error_text(run.error)}</span>
      {run.refused_step !== undefined && <Show store={store} step={run.refused_step} />}
    </>
  );
}

function Progress({ store, run }: { store: SequenceStore; run: Run }) {
  const console = useConsole();
  const entries = [...run.entries];
  const all = entries.map(([, entry]) => entry);
  const ended = all.filter(has_ended);
  const failed =
    entries.find(([, one]) => has_ended(one) && one.state !== 'OK' && one.state !== 'ABORT') ??
    entries.find(([, one]) => has_ended(one) && one.state !== 'OK');
  const is_over = ended.length === all.length;
  const took = duration(is_over ? last_end(all) - run.sent_at : Math.max(0, console.time() - run.sent_at));
  return (
    <>
      {is_over ? (
        <StatusBadge status={failed ? failed[1].state : 'OK'} />
      ) : (
        <Badge tone={store.is_running ? 'busy' : 'warning'}>{store.is_running ? texts.running() : texts.stopped()}</Badge>
      )}
      <span>
        {is_over && !failed ? texts.all_done(took) : texts.done_of(ended.filter((one) => one.state === 'OK').length, all.length, took)}
      </span>
      {failed && (
        <>
          <span class="sequence-why">
            {[texts.failed(`${failed[1].component} ${failed[1].command_type}`, failed[1].state), ...why(console, failed[1])].join(' ')}
          </span>
          <Show store={store} step={failed[0]} />
        </>
      )}
    </>
  );
}

function Show({ store, step }: { store: SequenceStore; step: number }) {
  return (
    <Button small onClick={() => (store.chosen.value = step)}>
      {texts.show_step()}
    </Button>
  );
}

function last_end(all: readonly CommandEntry[]): number {
  return Math.max(...all.map((one) => one.ended_at ?? 0));
}
