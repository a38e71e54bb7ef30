// Checks a scenario against the engine's profile and warns. The scenario may still run, because engines change.
import type { ComponentView, ProfileState } from '../state/engine/profile_state';
import type { Scenario, ScenarioCommand } from './model';
import type { Problem } from './read';
import { line_and_column, type Node } from './source';
import * as texts from './texts';
import { Trouble, type Say } from './trouble';
import { known_arguments, typed_arguments } from './typed';

export function against_engine(scenario: Scenario, text: string, profile: ProfileState): Problem[] {
  const found: Problem[] = [];
  const complain = (node: Node, say: Say) => found.push({ say, node, ...line_and_column(text, node.start) });
  const meant = new Map<string, ComponentView | undefined>();
  for (const { name, ref, type, node } of scenario.components) {
    const component = ref !== '' ? profile.component(ref) : profile.of_type(type)[0];
    meant.set(name, component);
    if (!component) complain(node, () => (ref !== '' ? texts.no_component(ref) : texts.none_of_type(type)));
  }
  const all = profile.components.value;
  const has_event = (component: ComponentView, type: string) =>
    component.events.some((one) => one.name.toLowerCase() === type.toLowerCase());
  const has_query = (component: ComponentView, type: string) =>
    component.queries.some((one) => one.name.toLowerCase() === type.toLowerCase());

  const check_command = ({ component: name, type, arguments: given, node }: ScenarioCommand): void => {
    const component = meant.get(name);
    if (!component) return;
    const is_known = type === 'set_parameter' || component.commands.some((one) => one.name.toLowerCase() === type.toLowerCase());
    if (!is_known) return void complain(node, () => texts.no_command(component.ref, type));
    const known = known_arguments(component, type);
    try {
      typed_arguments(component, type, given.filter(({ text: value }) => !value.includes('{')));
      for (const { name: argument } of given)
        if (!known.some((one) => one.name.toLowerCase() === argument.toLowerCase()))
          complain(node, () =>
            texts.no_argument(
              component.ref,
              argument,
              known.map((one) => one.name),
            ),
          );
    } catch (trouble) {
      if (trouble instanceof Trouble) complain(node, trouble.say);
    }
  };

  for (const state of scenario.states.values()) {
    for (const command of [...state.commands, ...state.leaving]) check_command(command);
    const { query } = state;
    const asked = query && (query.component === '' ? all : [meant.get(query.component)].filter((one) => one !== undefined));
    if (query && asked!.length > 0 && !asked!.some((one) => has_query(one, query.type)))
      complain(query.node, () => texts.no_query_of(query.type));
    for (const { kind, event_type, component, node } of state.triggers) {
      if (kind !== 'event') continue;
      const senders = component === '' ? all : [meant.get(component)].filter((one) => one !== undefined);
      if (senders.length > 0 && !senders.some((one) => has_event(one, event_type))) complain(node, () => texts.no_event_of(event_type));
    }
  }
  return found;
}
