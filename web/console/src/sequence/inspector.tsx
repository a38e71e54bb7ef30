// The form of the selected step: component, command, arguments, delay, branches.
import { useConsole } from '../context';
import { ArgumentFields } from '../forms/argument_fields';
import { CommandProgress } from '../forms/command_progress';
import { asked_by, command_types, same } from '../forms/describe';
import type { ComponentView } from '../state/engine/profile_state';
import { Button, EmptyState, error_text, Form, SelectField, TextField } from '../ui';
import { is_unfinished, type Problem } from './checking';
import { type CommandStep, found, type ParallelStep, type Step, with_branch, with_changed, without_branch } from './model';
import type { SequenceStore } from './store';
import * as texts from './texts';

interface MillisecondsProps {
  label: string;
  value: string;
  change: (to: string) => void;
  error: string | undefined;
  placeholder?: string;
}

function Milliseconds({ placeholder = '', ...field }: MillisecondsProps) {
  return <TextField {...field} unit="ms" input={{ inputMode: 'numeric', placeholder }} />;
}

export function Inspector({ store }: { store: SequenceStore }) {
  const step = found(store.root.value, store.chosen.value)?.step;
  if (!step) return <EmptyState icon="sequence" title={texts.choose_step()}>{texts.keys()}</EmptyState>;
  const problem = store.problems.value.find((one) => one.step === step.id);
  const change = (to: Partial<Step>) => store.change(with_changed(store.root.value, step.id, (one) => ({ ...one, ...to }) as Step));
  const shown = problem && (store.is_strict.value || !is_unfinished(problem)) ? problem : undefined;
  return (
    <Form key={step.id} class="sequence-form">
      <Outcome store={store} step={step} />
      {step.kind === 'command' && <CommandForm step={step} problem={shown} all={problem} change={change} />}
      {step.kind === 'wait' && (
        <div class="sequence-fields">
          <Milliseconds label={texts.wait_time()} value={step.time} change={(time) => change({ time })} error={shown && texts.no_time()} />
        </div>
      )}
      {step.kind === 'parallel' && <BranchesForm store={store} step={step} problem={shown} change={change} />}
    </Form>
  );
}

// The outcome, and why it failed.
function Outcome({ store, step }: { store: SequenceStore; step: Step }) {
  const run = store.run.value;
  const entry = run?.entries.get(step.id);
  if (entry) return <CommandProgress entry={entry} />;
  return run?.refused_step === step.id ? <p class="field-error">{error_text(run.error)}</p> : null;
}

interface CommandFormProps {
  step: CommandStep;
  problem: Problem | undefined;
  /** The problem, even if it is not shown yet. */
  all: Problem | undefined;
  change: (to: Partial<CommandStep>) => void;
}

const complaints = {
  no_component: texts.no_component,
  unknown_component: texts.unknown_component,
  no_command: texts.no_command,
  unknown_command: texts.unknown_command,
  no_time: texts.no_time,
};

function CommandForm({ step, problem, all, change }: CommandFormProps) {
  const { profile } = useConsole();
  const view = profile.component(step.component);
  const choose = (ref: string) => {
    const types = types_of(profile.component(ref));
    change({
      component: ref,
      command_type: types.find((one) => same(one, step.command_type)) ?? types.find((one) => same(one, 'start')) ?? types[0] ?? '',
    });
  };
  const refs = profile.components.value.filter((one) => types_of(one).length > 0).map((one) => one.ref);
  const error = (...kinds: (keyof typeof complaints)[]) => kinds.filter((one) => one === problem?.what).map((one) => complaints[one]())[0];
  const asked = view ? asked_by(view, step.command_type) : [];
  const missing = all?.what === 'arguments' && problem === undefined ? {} : (all?.fields ?? {});
  return (
    <>
      <div class="sequence-fields">
        <SelectField
          label={texts.component()}
          value={step.component}
          change={choose}
          choices={listed(refs, step.component, texts.choose())}
          error={error('no_component', 'unknown_component')}
        />
        <SelectField
          label={texts.command()}
          value={step.command_type}
          change={(command_type) => change({ command_type })}
          choices={listed(types_of(view), step.command_type, texts.choose())}
          error={error('no_command', 'unknown_command')}
        />
        <TextField
          label={texts.delay()}
          unit="ms"
          value={step.delay}
          change={(delay) => change({ delay })}
          error={error('no_time')}
          input={{ inputMode: 'numeric', placeholder: '0' }}
        />
      </div>
      {view && asked.length > 0 && (
        <ArgumentFields
          key={`${view.ref} ${step.command_type}`}
          view={view}
          asked={asked}
          inputs={step.inputs}
          change={(inputs) => change({ inputs })}
          problems={missing}
        />
      )}
      {step.unknown.length > 0 && (
        <p class="field-error">
          {texts.unknown_arguments_are(step.unknown.map((one) => one.name).join(', '))}{' '}
          <Button small onClick={() => change({ unknown: [] })}>
            {texts.drop_arguments()}
          </Button>
        </p>
      )}
    </>
  );
}

function types_of(view: ComponentView | undefined): string[] {
  return view ? command_types(view) : [];
}

// Includes the chosen value even if it is unknown.
function listed(all: readonly string[], chosen: string, choose: string) {
  const listed_ones = all.includes(chosen) ? all : [chosen, ...all];
  return listed_ones.map((value) => ({ value, label: value === '' ? choose : value }));
}

function BranchesForm({
  store,
  step,
  problem,
  change,
}: {
  store: SequenceStore;
  step: ParallelStep;
  problem: Problem | undefined;
  change: (to: Partial<ParallelStep>) => void;
}) {
  const remove = (lane: number) => {
    store.change(without_branch(store.root.value, lane));
    if (!found(store.root.value, step.id)) store.chosen.value = 0;
  };
  return (
    <>
      <div class="sequence-fields">
        <Milliseconds
          label={texts.delay()}
          value={step.delay}
          change={(delay) => change({ delay })}
          error={problem?.what === 'no_time' ? texts.no_time() : undefined}
          placeholder="0"
        />
      </div>
      {problem?.what === 'no_branches' && <p class="field-error">{texts.no_branches()}</p>}
      <ul class="sequence-list">
        {step.branches.map((one, i) => (
          <li key={one.id} class="row-spread">
            <span>
              {texts.branch(i + 1)}: {texts.count(one.steps.length)}
            </span>
            <Button small look="quiet" icon="close" onClick={() => remove(one.id)}>
              {texts.remove_branch(i + 1)}
            </Button>
          </li>
        ))}
      </ul>
      <div>
        <Button small icon="plus" onClick={() => store.change(with_branch(store.root.value, step.id))}>
          {texts.add_branch()}
        </Button>
      </div>
    </>
  );
}
