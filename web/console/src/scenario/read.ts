// Reads scenarios as `rois scenario` does (schemas/scenario.xsd and further rules), and reports all problems.
import { type CompletedStatus, type Switching, XmlError } from 'rois-client';

import { type ElementRule, is_of, namespace, rule_of, steps, to_double, triggers } from './grammar';
import type { Relation, Scenario, ScenarioCommand, State, Step, Trigger, TriggerKind } from './model';
import { line_and_column, type Node, read_source } from './source';
import * as texts from './texts';
import type { Say } from './trouble';
import { names_in } from './variables';

export interface Problem {
  say: Say;
  /** In the text, from 1. */
  line: number;
  column: number;
  node?: Node;
}

/** `scenario` is set if there are no problems; `root` if the text is well-formed. */
export interface Reading {
  text: string;
  root?: Node;
  scenario?: Scenario;
  problems: Problem[];
}

export function read_scenario(text: string): Reading {
  try {
    const root = read_source(text);
    const reader = new ScenarioReader(text, root);
    const scenario = reader.scenario();
    return reader.problems.length === 0 ? { text, root, scenario, problems: [] } : { text, root, problems: reader.problems };
  } catch (error) {
    if (!(error instanceof XmlError)) throw error;
    return { text, problems: [{ say: () => error.message.replace(/ at offset \d+$/, ''), ...line_and_column(text, error.offset) }] };
  }
}

const relations = ['is', 'is_not', 'in', 'not_in', 'empty', 'near'] as const;

class ScenarioReader {
  readonly problems: Problem[] = [];
  private readonly components = new Set<string>();
  private readonly variables = new Map<string, string>();
  private readonly states = new Map<string, State>();

  constructor(
    private readonly text: string,
    private readonly root: Node,
  ) {}

  scenario(): Scenario {
    const { root } = this;
    if (root.name !== 'robot_scenario') this.complain(root, () => texts.not_a_scenario(root.name));
    else this.check_grammar(root);
    const made: Scenario = {
      name: attribute(root, 'name'),
      start: name(root, 'start'),
      components: [],
      variables: this.variables,
      states: this.states,
      root,
    };
    if (this.problems.length > 0) return made;
    const of = (...names: string[]) => root.children.filter((one) => names.includes(one.name));
    for (const node of of('component')) made.components.push(this.component(node));
    for (const node of of('variable')) this.variable(node);
    for (const node of of('state', 'end')) this.announce(node);
    this.check_state(root, made.start);
    for (const node of of('state', 'end')) this.states.set(name(node, 'name'), this.state(node));
    return made;
  }

  private complain(node: Node, say: Say): void {
    this.problems.push({ say, node, ...line_and_column(this.text, node.start) });
  }

  // --- Schema ---

  private check_grammar(node: Node): void {
    const rule = rule_of(node.name);
    if (!rule) return; // reported with its parent
    if (node.element.namespace !== namespace) return this.complain_of_namespace(node);
    this.check_attributes(node, rule);
    this.check_content(node, rule);
    const text = node.element.text.trim();
    if (!rule.text && text !== '') this.complain(node, () => texts.no_text_here(text, node.name));
    for (const child of node.children) this.check_grammar(child);
  }

  private check_attributes(node: Node, rule: ElementRule): void {
    for (const { name: given, namespace: of, value } of node.element.attributes) {
      const expected = of === '' && Object.hasOwn(rule.attributes, given) ? rule.attributes[given] : undefined;
      if (of === '' && !expected) this.complain(node, () => texts.unknown_attribute(given, node.name, Object.keys(rule.attributes)));
      if (expected && !is_of(expected.type, value)) this.complain(node, () => texts.wrong_value(given, node.name, value, expected.type));
    }
    for (const [needed, { required }] of Object.entries(rule.attributes))
      if (required && node.element.attribute(needed) === undefined) this.complain(node, () => texts.missing_attribute(needed, node.name));
  }

  private complain_of_namespace(node: Node): void {
    const { namespace: given } = node.element;
    const { parent } = node;
    this.complain(node, () =>
      parent ? texts.other_namespace(node.name, parent.name, namespace, given) : texts.unknown_root(node.name, given),
    );
  }

  private check_content(node: Node, { content }: ElementRule): void {
    let at = 0;
    let expected: string[] = []; // the elements that may follow the last one
    for (const { names, least, most } of content) {
      let count = 0;
      for (; count < most && names.includes(node.children[at]?.name ?? ''); ++at) count += 1;
      expected = [...(count === 0 ? expected : []), ...(count < most ? names : [])];
      if (count < least && !node.children[at]) return this.complain(node, () => texts.missing_element(names, node.name));
      if (count < least) break;
    }
    const found = node.children[at];
    if (!found) return;
    if (rule_of(node.name)!.content.some(({ names }) => names.includes(found.name)))
      this.complain(found, () => texts.element_out_of_order(found.name, node.name, expected));
    else this.complain(found, () => texts.unknown_element(found.name, node.name, expected));
  }

  // --- Content ---

  private component(node: Node): Scenario['components'][number] {
    const read: Scenario['components'][number] = { name: name(node, 'name'), ref: name(node, 'ref'), type: name(node, 'type'), node };
    const switching = node.element.attribute('switching');
    if (switching !== undefined) read.switching = switching.trim() as Switching;
    if (read.ref !== '' && read.type !== '') this.complain(node, () => texts.ref_or_type());
    if (read.ref === '' && read.type === '') read.ref = read.name;
    if (this.components.has(read.name)) this.complain(node, () => texts.duplicate('component', read.name));
    this.components.add(read.name);
    return read;
  }

  private variable(node: Node): void {
    const own = name(node, 'name');
    if (this.variables.has(own)) this.complain(node, () => texts.duplicate('variable', own));
    this.variables.set(own, node.element.text.trim());
  }

  // Collects all states before targets are checked.
  private announce(node: Node): void {
    const own = name(node, 'name');
    if (this.states.has(own)) this.complain(node, () => texts.duplicate('state', own));
    this.states.set(own, empty_state(node));
  }

  private state(node: Node): State {
    const state = empty_state(node);
    state.failed = is_true(attribute(node, 'failed'));
    for (const child of node.children) {
      if (child.name === 'command') state.commands.push(this.command(child));
      else if (child.name === 'query') state.query = { type: name(child, 'type'), component: this.known_component(child), node: child };
      else if (child.name === 'leaving') state.leaving = child.children.map((one) => this.command(one));
      else if ((triggers as readonly string[]).includes(child.name)) state.triggers.push(this.trigger(child));
      else state.steps.push(this.step(child));
    }
    this.check_ways_out(state);
    return state;
  }

  private check_ways_out({ node, is_end, triggers: out, commands, query }: State): void {
    if (is_end) return;
    if (out.length === 0) this.complain(node, () => texts.no_way_out());
    if (commands.length === 0 && out.some(({ kind }) => kind === 'completed')) this.complain(node, () => texts.no_commands());
    if (!query && out.some(({ kind }) => kind === 'answered')) this.complain(node, () => texts.no_query());
  }

  private command(node: Node): ScenarioCommand {
    const read: ScenarioCommand = {
      component: this.known_component(node),
      type: name(node, 'type'),
      arguments: node.children.map((one) => ({ name: name(one, 'name'), text: this.known_text(one, one.element.text.trim()) })),
      node,
    };
    if (node.element.attribute('delay') !== undefined) read.delay = Number(attribute(node, 'delay'));
    return read;
  }

  private trigger(node: Node): Trigger {
    const kind = node.name as TriggerKind;
    const read: Trigger = {
      kind,
      event_type: kind === 'event' ? name(node, 'type') : '',
      component: this.known_component(node),
      seconds: this.known_text(node, attribute(node, 'seconds')),
      steps: [],
      to: name(node, 'to'),
      node,
    };
    const status = node.element.attribute('status');
    if (status !== undefined) read.status = status.trim() as CompletedStatus;
    this.check_state(node, read.to);
    const has_results = kind === 'event' || kind === 'answered';
    for (const child of node.children) {
      if (child.name === 'take' && !has_results) this.complain(child, () => texts.nothing_to_take());
      read.steps.push(this.step(child));
    }
    return read;
  }

  private step(node: Node): Step {
    const kind = node.name as (typeof steps)[number];
    const text = () => this.known_text(node, node.element.text.trim());
    if (kind === 'print') return { kind, text: text() };
    const variable = this.known_variable(node, name(node, 'variable'));
    switch (kind) {
      case 'set':
      case 'add':
        return { kind, variable, text: text() };
      case 'count':
        return { kind, variable };
      case 'take':
        return this.take_result(node, variable);
      case 'when':
        return this.when(node, variable);
      default:
        return {
          kind,
          variable,
          before: this.known_text(node, attribute(node, 'before')),
          distance: number(node, 'distance'),
          turn: number(node, 'turn'),
        };
    }
  }

  private take_result(node: Node, variable: string): Step {
    const has = (one: string) => node.element.attribute(one) !== undefined;
    if (has('apart') && !has('not_in')) this.complain(node, () => texts.needs_list());
    if (has('beside') !== has('is')) this.complain(node, () => texts.need_each_other('beside', 'is'));
    return {
      kind: 'take',
      variable,
      result: name(node, 'result'),
      not_in: this.known_variable(node, name(node, 'not_in')),
      beside: name(node, 'beside'),
      is: this.known_text(node, attribute(node, 'is')),
      apart: number(node, 'apart'),
    };
  }

  private when(node: Node, variable: string): Step {
    const given = relations.filter((one) => node.element.attribute(one) !== undefined);
    if (given.length !== 1) this.complain(node, () => texts.one_relation(relations.join(', ')));
    let relation: Relation = given[0] ?? 'is';
    const operand = this.known_text(node, attribute(node, relation));
    if (relation === 'in' || relation === 'not_in') this.known_variable(node, operand);
    if (relation === 'empty' && !is_true(operand)) relation = 'not_empty';
    if ((relation === 'near') !== (node.element.attribute('within') !== undefined))
      this.complain(node, () => texts.need_each_other('near', 'within'));
    return { kind: 'when', variable, relation, operand, within: number(node, 'within') };
  }

  // --- References ---

  private check_state(node: Node, to: string): void {
    if (!this.states.has(to)) this.complain(node, () => texts.no_such('state', to, [...this.states.keys()]));
  }

  private known_component(node: Node): string {
    const used = name(node, 'component');
    if (used !== '' && !this.components.has(used)) this.complain(node, () => texts.no_such('component', used, [...this.components]));
    return used;
  }

  private known_variable(node: Node, used: string): string {
    if (used !== '' && !this.variables.has(used)) this.complain(node, () => texts.no_such('variable', used, [...this.variables.keys()]));
    return used;
  }

  private known_text(node: Node, text: string): string {
    for (const used of names_in(text)) this.known_variable(node, used);
    return text;
  }
}

function attribute(node: Node, of: string): string {
  return node.element.attribute(of) ?? '';
}

function empty_state(node: Node): State {
  return { name: name(node, 'name'), steps: [], commands: [], triggers: [], leaving: [], is_end: node.name === 'end', failed: false, node };
}

function name(node: Node, of: string): string {
  return attribute(node, of).trim();
}

function number(node: Node, of: string): number {
  return to_double(attribute(node, of)) ?? 0;
}

function is_true(text: string): boolean {
  return /^(true|1)$/.test(text.trim());
}
