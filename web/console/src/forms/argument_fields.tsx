// Fields for the arguments of a command.
import './forms.css';

import type { Parameter } from 'rois-client';

import { useConsole, useWatch } from '../context';
import type { Console } from '../state/console';
import type { ComponentView } from '../state/engine/profile_state';
import { data_type, type Problem } from './data_type';
import type { Asked } from './describe';
import { type Inputs, parameters_from, problems_of, with_input } from './inputs';
import { options_for, type World } from './options';
import { ParameterField } from './parameter_field';

export interface ArgumentFieldsProps {
  view: ComponentView;
  asked: readonly Asked[];
  inputs: Inputs;
  change: (inputs: Inputs) => void;
  /** Problems by parameter name, from `problems_in`. Omit those that the user need not see yet. */
  problems: Readonly<Record<string, Problem>>;
}

export function ArgumentFields({ view, asked, inputs, change, problems }: ArgumentFieldsProps) {
  const console = useConsole();
  useWatch(console.parameters.poll(view.ref));
  const current = console.parameters.of(view.ref);
  const has_things = asked.some(is_of_things);
  if (has_things) void console.now.value; // robots and persons change all the time: updating once a second is enough
  const world = what_there_is(console, view.ref);
  return (
    <div class="form-fields">
      {has_things && <LooksAtRobots />}
      {asked.map((one) => (
        <ParameterField
          key={one.name}
          asked={one}
          input={inputs[one.name]}
          change={(input) => change(with_input(inputs, one.name, input))}
          problem={problems[one.name]}
          options={options_for(one, world)}
          now={current?.texts(one.name).join('; ') || undefined}
        />
      ))}
    </div>
  );
}

/** Problems in the entered values. A value that the component already has may be omitted. */
export function problems_in(console: Console, ref: string, asked: readonly Asked[], inputs: Inputs): Record<string, Problem> {
  const current = console.parameters.of(ref);
  return problems_of(asked, inputs, (name) => current !== undefined && current.texts(name).length > 0);
}

/** The entered values as parameters of a message. Identifiers get the codebook of the chosen option. */
export function arguments_in(console: Console, ref: string, asked: readonly Asked[], inputs: Inputs): Parameter[] {
  const world = what_there_is(console, ref);
  return parameters_from(asked, inputs, (name, code) => {
    const one = asked.find((each) => each.name === name);
    return one && options_for(one, world).list.find(({ value }) => value === code)?.codebook;
  });
}

function what_there_is({ map, robots, entities, profile, parameters }: Console, ref: string): World {
  const view = map.view.value;
  return {
    places: view.state === 'there' ? view.map.places.map((one) => one.name) : [],
    robots: robots.all.values(),
    entities: entities.all.values(),
    components: profile.components.value.map((one) => one.ref),
    parameters: parameters.of(ref),
  };
}

function is_of_things({ name, data_type_ref }: Asked): boolean {
  return data_type(data_type_ref.code).kind === 'identifier' && /robot|person|face|sound|object|target/i.test(name);
}

// Watches the robots, so that the list of options is current.
function LooksAtRobots() {
  useWatch(useConsole().robots.poll);
  return null;
}
