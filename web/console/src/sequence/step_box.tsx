// A step in the drawing, with its progress.
import type { ComponentChildren } from 'preact';

import { useConsole } from '../context';
import { duration } from '../i18n/i18n';
import { Icon, joined, StatusBadge } from '../ui';
import { is_unfinished } from './checking';
import type { LaneContext } from './lane_context';
import type { CommandStep, ParallelStep, Step, WaitStep } from './model';
import type { StepState } from './running';
import * as texts from './texts';
import { milliseconds } from './units';

type Of<T extends Step> = { step: T; context: LaneContext };

export function CommandBox({ step, context }: Of<CommandStep>) {
  return (
    <Box step={step} context={context} kind="command">
      <span class="sequence-title">{step.component || texts.no_component()}</span>
      <span class="sequence-what">
        {step.delay.trim() !== '' && <Delay text={step.delay} />}
        {step.command_type || texts.no_command()}
      </span>
      <span class="sequence-arguments">{said_by(step)}</span>
    </Box>
  );
}

export function WaitBox({ step, context }: Of<WaitStep>) {
  return (
    <Box step={step} context={context} kind="wait">
      <span class="sequence-title">
        <Icon name="clock" /> {texts.wait()}
      </span>
      <span class="sequence-what">{time_text(step.time)}</span>
    </Box>
  );
}

export function ParallelHead({ step, context }: Of<ParallelStep>) {
  return (
    <Box step={step} context={context} kind="parallel">
      <span class="sequence-what">
        {step.delay.trim() !== '' && <Delay text={step.delay} />}
        {texts.together(step.branches.length)}
      </span>
    </Box>
  );
}

function Delay({ text }: { text: string }) {
  return (
    <span class="sequence-delay" title={texts.delay()}>
      <Icon name="clock" size={12} /> {time_text(text)}
    </span>
  );
}

function time_text(text: string): string {
  const time = milliseconds(text);
  return time === undefined ? '?' : duration(time);
}

// Only the values; the form shows their names.
function said_by({ inputs }: CommandStep): string {
  return Object.values(inputs)
    .map(({ texts: values }) => values.filter((one) => one.trim() !== '').join(' → '))
    .filter((one) => one !== '')
    .join(' · ');
}

function Box({ step, context, kind, children }: Of<Step> & { kind: Step['kind']; children: ComponentChildren }) {
  const { store, view, drag, first } = context;
  const state = view.get(step.id);
  const problem = store.problems.value.find((one) => one.step === step.id);
  const is_refused = store.run.value?.refused_step === step.id;
  const is_bad = is_refused || (problem !== undefined && (store.is_strict.value || !is_unfinished(problem)));
  const name = joined(
    'sequence-box',
    kind === 'wait' && 'sequence-wait',
    kind === 'parallel' && 'sequence-parallel',
    state && `sequence-is-${state.state}`,
    problem && !is_bad && 'sequence-unfinished',
    is_bad && 'sequence-bad',
    drag.dragged === step.id && 'sequence-dragged',
  );
  return (
    <button
      type="button"
      class={name}
      data-step={step.id}
      tabIndex={step.id === first ? 0 : -1}
      aria-pressed={store.chosen.value === step.id}
      onClick={() => (store.chosen.value = step.id)}
      onFocus={() => (store.chosen.value = step.id)}
      {...drag.handlers(step.id)}
    >
      {children}
      {is_bad && (
        <span class="sequence-problem">
          <Icon name="warning" size={13} /> {is_refused ? texts.refused() : texts.has_problem()}
        </span>
      )}
      {state && <StateLine state={state} />}
    </button>
  );
}

function StateLine({ state: { state, since, took } }: { state: StepState }) {
  const console = useConsole();
  const time = took ?? (since === undefined ? undefined : Math.max(0, console.time() - since));
  return (
    <span class="sequence-state">
      <StatusBadge status={state} />
      {time !== undefined && <span class="sequence-time">{duration(time)}</span>}
    </span>
  );
}
