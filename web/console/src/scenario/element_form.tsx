// A form for an element: attributes, text and children.
import { useConsole } from '../context';
import type { ProfileState } from '../state/engine/profile_state';
import { IconButton, SelectField, TextField } from '../ui';
import type { Desk } from './desk';
import { closed_choices, relation_of, relations, steps_for, suggestions, with_new, with_relation } from './editing';
import { actions, type AttributeRule, type AttributeType, is_of, rule_of, statuses, switchings } from './grammar';
import type { Problem } from './read';
import { moved, type Node, read_source, with_attribute, with_state_renamed, with_text, without } from './source';
import * as texts from './texts';

export interface FormProps {
  desk: Desk;
  root: Node;
  node: Node;
}

/** Problems of an element in words. */
export function problems_at(problems: readonly Problem[], node: Node): string[] {
  return problems.filter((one) => one.node?.path === node.path).map(({ say }) => say());
}

/** With its name and buttons to move and remove it. */
export function ElementCard({ desk, root, node }: FormProps) {
  const title = texts.element(node.name);
  const sisters = (node.parent?.children ?? []).filter((one) => same_group(one, node));
  const { text } = desk;
  const may_not = desk.is_running.value;
  const problems = problems_at(desk.reading.value.problems, node);
  const is_step = node.parent !== undefined && node.parent.name !== 'state' && node.parent.name !== 'robot_scenario';
  return (
    <div class={`scenario-card scenario-card-${is_step ? 'step' : 'own'}`} data-element={node.name} role="group" aria-label={title}>
      <header>
        <span class="scenario-card-title">{title}</span>
        {sisters.length > 1 && (
          <>
            <IconButton
              small
              icon="up"
              label={texts.earlier(title)}
              disabled={may_not || sisters[0] === node}
              onClick={() => desk.edit(moved(text.value, node, -1), '')}
            />
            <IconButton
              small
              icon="down"
              label={texts.later(title)}
              disabled={may_not || sisters.at(-1) === node}
              onClick={() => desk.edit(moved(text.value, node, 1), '')}
            />
          </>
        )}
        <IconButton
          small
          icon="close"
          label={texts.remove(title)}
          disabled={may_not}
          onClick={() => desk.edit(without(text.value, node), '')}
        />
      </header>
      {problems.map((one) => <p key={one} class="field-error">{one}</p>)}
      <ElementFields desk={desk} root={root} node={node} />
      {node.children.length > 0 && (
        <div class="scenario-steps">
          {node.children.map((child) => <ElementCard key={child.path} desk={desk} root={root} node={child} />)}
        </div>
      )}
      <Adder desk={desk} root={root} parent={node} names={addable(node)} />
    </div>
  );
}

function same_group(a: Node, b: Node): boolean {
  return rule_of(b.parent?.name ?? '')?.content.some(({ names }) => names.includes(a.name) && names.includes(b.name)) ?? false;
}

function addable(node: Node): readonly string[] {
  if (node.name === 'command') return ['argument'];
  if (node.name === 'leaving') return ['command'];
  return rule_of(node.name)?.content.length === 1 ? steps_for(node) : [];
}

/** A menu to add an element; a button if there is only one kind. */
export function Adder({ desk, root, parent, names }: { desk: Desk; root: Node; parent: Node; names: readonly string[] }) {
  if (names.length === 0) return null;
  const state = name_of_state(parent);
  const add = (name: string) => name !== '' && desk.edit(with_new(desk.text.value, parent, name, root, state), '');
  return (
    <div class="scenario-adder">
      <select
        aria-label={`${texts.add_choose()} ${texts.element(parent.name)}`}
        value=""
        disabled={desk.is_running.value}
        onChange={(event) => {
          add(event.currentTarget.value);
          event.currentTarget.value = '';
        }}
      >
        <option value="">{texts.add_choose()}</option>
        {names.map((one) => <option key={one} value={one}>{texts.element(one)}</option>)}
      </select>
    </div>
  );
}

function name_of_state(node: Node | undefined): string {
  if (!node) return '';
  return node.name === 'state' || node.name === 'end' ? (node.element.attribute('name') ?? '') : name_of_state(node.parent);
}

/** Fields of its attributes and text. */
export function ElementFields({ desk, root, node }: FormProps) {
  const rule = rule_of(node.name);
  if (!rule) return null;
  const change_text = (value: string) => desk.edit(with_text(desk.text.value, node, value), `text ${node.path}`);
  const names = Object.keys(rule.attributes);
  const is_given = (name: string) => node.element.attribute(name) !== undefined;
  // Rarely used attributes are hidden until requested.
  const hidden =
    node.name === 'take' || node.name === 'place' || node.name === 'command'
      ? names.filter((name) => !rule.attributes[name]!.required && !is_given(name))
      : [];
  const field = (name: string) => (
    <AttributeField key={name} desk={desk} root={root} node={node} name={name} rule={rule.attributes[name]!} />
  );
  if (node.name === 'when') return <WhenFields desk={desk} root={root} node={node} />;
  return (
    <>
      {names.length > hidden.length && <div class="scenario-fields">{names.filter((one) => !hidden.includes(one)).map(field)}</div>}
      {rule.text && (
        <TextField
          hide_label
          label={texts.value_of(texts.element(node.name))}
          value={node.element.text.trim()}
          change={change_text}
          input={{ disabled: desk.is_running.value, placeholder: texts.text_with() }}
        />
      )}
      {hidden.length > 0 && (
        <details class="scenario-more">
          <summary>{texts.more()}</summary>
          <div class="scenario-fields">{hidden.map(field)}</div>
        </details>
      )}
    </>
  );
}

function AttributeField({ desk, root, node, name, rule }: FormProps & { name: string; rule: AttributeRule }) {
  const { profile } = useConsole();
  const value = node.element.attribute(name);
  const label = texts.attribute(name);
  const is_locked = desk.is_running.value;
  const change = (to: string) => {
    const wanted = to === '' && !rule.required ? undefined : to;
    const is_name_of_state = name === 'name' && (node.name === 'state' || node.name === 'end');
    if (is_name_of_state && value !== undefined && desk.chosen.value === value) desk.chosen.value = to;
    desk.edit(
      is_name_of_state && value !== undefined
        ? with_state_renamed(desk.text.value, root, value.trim(), to)
        : with_attribute(desk.text.value, node, name, wanted),
      `${node.path} ${name}`,
    );
  };
  const words: Partial<Record<AttributeType, readonly string[]>> = { status: statuses, switching: switchings, boolean: ['true', 'false'] };
  const closed = words[rule.type] ?? closed_choices(rule.type, root);
  if (closed) {
    const now = (value ?? '').trim();
    const none = rule.required
      ? []
      : [{ value: '', label: name === 'status' || name === 'component' ? texts.none_chosen() : texts.not_given() }];
    const unknown = now !== '' && !closed.includes(now) ? [{ value: now, label: `${now} ?` }] : [];
    const choices = [...none, ...closed.map((one) => ({ value: one, label: one })), ...unknown];
    return (
      <fieldset class="scenario-lock" disabled={is_locked}>
        <SelectField label={label} value={now} change={change} choices={choices} required={rule.required} />
      </fieldset>
    );
  }
  const wrong = value !== undefined && !is_of(rule.type, value) ? texts.wrong_value(name, node.name, value, rule.type) : undefined;
  const meant = (component: string) => component_meant(root, component, profile);
  return (
    <TextField
      label={label}
      value={value ?? ''}
      change={change}
      required={rule.required}
      error={wrong}
      options={suggestions(node, name, profile.components.value, meant)}
      input={{ disabled: is_locked }}
    />
  );
}

function component_meant(root: Node, name: string, profile: ProfileState) {
  const node = root.children.find((one) => one.name === 'component' && one.element.attribute('name')?.trim() === name.trim());
  const [ref, type] = [node?.element.attribute('ref'), node?.element.attribute('type')];
  if (!node) return undefined;
  return type !== undefined ? profile.of_type(type)[0] : profile.component(ref ?? name);
}

// A `when` has one relation, which is chosen first.
function WhenFields({ desk, root, node }: FormProps) {
  const relation = relation_of(node);
  const rules = rule_of('when')!.attributes;
  const first_variable = closed_choices('variable', root)?.[0] ?? '';
  const turn = (to: (typeof relations)[number]) => desk.edit(with_relation(desk.text.value, node, to, read_source, first_variable), '');
  const field = (name: string, required = true) => (
    <AttributeField key={name} desk={desk} root={root} node={node} name={name} rule={{ ...rules[name]!, required }} />
  );
  return (
    <div class="scenario-fields">
      {field('variable')}
      <fieldset class="scenario-lock" disabled={desk.is_running.value}>
        <SelectField
          label={texts.relation()}
          value={relation ?? 'is'}
          change={turn}
          choices={relations.map((one) => ({ value: one, label: texts.attribute(one).replace('_', ' ') }))}
        />
      </fieldset>
      {relation && field(relation)}
      {relation === 'near' && field('within')}
    </div>
  );
}

/** Elements that run on entering a state. */
export const entering: readonly string[] = [...actions, 'command', 'query'];
