// Editing in forms: the place and content of new elements, and choices for values.
import type { ComponentView } from '../state/engine/profile_state';
import { type AttributeType, rule_of, steps } from './grammar';
import { type Node, nodes_in, with_attribute, with_child } from './source';

/** The names of all elements of these kinds, in order. */
export function names_of(root: Node, ...elements: string[]): string[] {
  return [...nodes_in(root)].filter((one) => elements.includes(one.name)).map((one) => (one.element.attribute('name') ?? '').trim());
}

/** The child before which a new element goes; undefined: at the end. */
function place_for(parent: Node, name: string): Node | undefined {
  const groups = rule_of(parent.name)?.content ?? [];
  const group = groups.findIndex((one) => one.names.includes(name));
  return parent.children.find((child) => groups.findIndex((one) => one.names.includes(child.name)) > group);
}

/** Whether one more is allowed. */
export function may_add(parent: Node, name: string): boolean {
  const group = rule_of(parent.name)?.content.find((one) => one.names.includes(name));
  return group !== undefined && parent.children.filter((one) => group.names.includes(one.name)).length < group.most;
}

/** A new element, filled with existing names so that it is as valid as possible. */
function begun(name: string, root: Node, state: string): string {
  const first = (...elements: string[]) => names_of(root, ...elements)[0] ?? '';
  const [variable, component] = [first('variable'), first('component')];
  const to = names_of(root, 'state', 'end').find((one) => one !== state) ?? state;
  switch (name) {
    case 'event':
      return `<event type="person_detected" to="${to}"/>`;
    case 'after':
      return `<after seconds="5" to="${to}"/>`;
    case 'completed':
    case 'answered':
    case 'at_once':
      return `<${name} to="${to}"/>`;
    case 'take':
      return `<take variable="${variable}" result="number"/>`;
    case 'when':
      return `<when variable="${variable}" is=""/>`;
    case 'set':
    case 'add':
    case 'count':
      return `<${name} variable="${variable}"/>`;
    case 'place':
      return `<place variable="${variable}" before="{${variable}}" distance="1000"/>`;
    case 'command':
      return `<command component="${component}" type="start"/>`;
    case 'argument':
      return '<argument name="argument"/>';
    case 'query':
      return '<query type="robot_position"/>';
    case 'leaving':
      return `<leaving>\n  <command component="${component}" type="stop"/>\n</leaving>`;
    case 'component':
      return `<component name="${unused(names_of(root, 'component'), 'component')}" type="Navigation"/>`;
    case 'variable':
      return `<variable name="${unused(names_of(root, 'variable'), 'variable')}"/>`;
    case 'state':
      return `<state name="${unused(names_of(root, 'state', 'end'), 'state')}">\n  <after seconds="5" to="${to}"/>\n</state>`;
    case 'end':
      return `<end name="${unused(names_of(root, 'state', 'end'), 'end')}"/>`;
    default:
      return `<${name}/>`;
  }
}

export function unused(names: readonly string[], wish: string): string {
  for (let i = 1; ; ++i) if (!names.includes(`${wish}_${i}`)) return `${wish}_${i}`;
}

/** The text with a new element in its place. */
export function with_new(text: string, parent: Node, name: string, root: Node, state: string): string {
  const prefix = /^[^:]+:/.exec(root.written)?.[0] ?? '';
  return with_child(text, parent, begun(name, root, state).replace(/<(\/?)/g, `<$1${prefix}`), place_for(parent, name));
}

// --- Conditions: a `when` has exactly one of these ---

export const relations = ['is', 'is_not', 'in', 'not_in', 'empty', 'near'] as const;

export function relation_of(node: Node): (typeof relations)[number] | undefined {
  return relations.find((one) => node.element.attribute(one) !== undefined);
}

/** The text with another relation; keeps the operand if it fits. */
export function with_relation(
  text: string,
  node: Node,
  to: (typeof relations)[number],
  read: (text: string) => Node,
  variable: string,
): string {
  const from = relation_of(node);
  const node_in = (changed: string) => at_path(read(changed), node.path);
  let changed = text;
  for (const name of ['within', ...relations])
    if (node_in(changed).element.attribute(name) !== undefined) changed = with_attribute(changed, node_in(changed), name, undefined);
  const was = from === undefined ? '' : (node.element.attribute(from) ?? '');
  const is_list = (one: string | undefined) => one === 'in' || one === 'not_in';
  let operand = was;
  if (to === 'empty') operand = 'true';
  else if (is_list(to) && !is_list(from)) operand = variable;
  else if (!is_list(to) && (is_list(from) || from === 'empty')) operand = '';
  changed = with_attribute(changed, node_in(changed), to, operand);
  return to === 'near' ? with_attribute(changed, node_in(changed), 'within', '500') : changed;
}

function at_path(root: Node, path: string): Node {
  return path.split('/').slice(1).reduce((node, index) => node.children[Number(index)]!, root);
}

// --- Choices ---

/** Names that must exist; no others are valid. */
export function closed_choices(type: AttributeType, root: Node): string[] | undefined {
  if (type === 'state') return names_of(root, 'state', 'end');
  if (type === 'variable') return names_of(root, 'variable');
  if (type === 'component') return names_of(root, 'component');
  return undefined;
}

/** Names that the engine knows; others may be valid later. */
export function suggestions(
  node: Node,
  attribute: string,
  components: readonly ComponentView[],
  meant: (name: string) => ComponentView | undefined,
): string[] | undefined {
  const own = meant(node.element.attribute('component') ?? '');
  const asked = own ? [own] : components;
  const all = (names: string[]) => [...new Set(names)].sort();
  if (attribute === 'type') {
    if (node.name === 'event') return all(asked.flatMap((one) => one.events.map(({ name }) => name)));
    if (node.name === 'query') return all(asked.flatMap((one) => one.queries.map(({ name }) => name)));
    if (node.name === 'command')
      return own && all([...own.commands.map(({ name }) => name), ...(own.parameters.length > 0 ? ['set_parameter'] : [])]);
    if (node.name === 'component') return all(components.map(({ type_name }) => type_name));
  }
  if (node.name === 'component' && attribute === 'ref') return all(components.map(({ ref }) => ref));
  const { parent } = node;
  if (node.name === 'argument' && parent) {
    const component = meant(parent.element.attribute('component') ?? '');
    const type = parent.element.attribute('type') ?? '';
    return (
      component &&
      all([...(component.commands.find((one) => one.name === type)?.arguments ?? []), ...component.parameters].map(({ name }) => name))
    );
  }
  if (node.name === 'take' && (attribute === 'result' || attribute === 'beside')) return results_of(parent, components);
  return undefined;
}

function results_of(trigger: Node | undefined, components: readonly ComponentView[]): string[] {
  const query = trigger?.parent?.children.find((one) => one.name === 'query');
  const asked = trigger?.name === 'event' ? trigger : query;
  const type = asked?.element.attribute('type');
  const messages = components.flatMap((one) => (asked?.name === 'query' ? one.queries : one.events)).filter((one) => one.name === type);
  return [...new Set(messages.flatMap((one) => one.results.map(({ name }) => name)))].sort();
}

/** The steps allowed in a trigger: only events and answers have results to take. */
export function steps_for(trigger: Node): readonly string[] {
  return trigger.name === 'event' || trigger.name === 'answered' ? steps : steps.filter((one) => one !== 'take');
}
