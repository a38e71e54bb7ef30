// Forms for a state and its triggers, or for the scenario itself.
import { Button, Icon, SelectField } from '../ui';
import type { Desk } from './desk';
import { may_add, names_of, unused, with_new } from './editing';
import { Adder, ElementCard, ElementFields, entering, problems_at } from './element_form';
import { triggers } from './grammar';
import { shown_name } from './picture';
import { type Node, without } from './source';
import * as texts from './texts';

export function EditView({ desk }: { desk: Desk }) {
  const { root } = desk.reading.value;
  if (!root || root.name !== 'robot_scenario') return <p class="scenario-nothing">{texts.cannot_draw()}</p>;
  const states = root.children.filter((one) => one.name === 'state' || one.name === 'end');
  const state = states.find((one) => name_of(one) === desk.chosen.value);
  const choices = [
    { value: '', label: texts.scenario_itself() },
    ...states.map((one) => ({ value: name_of(one), label: shown_name(name_of(one)) })),
  ];
  const add = (name: 'state' | 'end') => {
    desk.chosen.value = unused(names_of(root, 'state', 'end'), name);
    desk.edit(with_new(desk.text.value, root, name, root, ''), '');
  };
  return (
    <div class="scenario-edit">
      {desk.is_running.value && <p class="scenario-locked"><Icon name="info" /> {texts.locked()}</p>}
      <div class="scenario-edit-head">
        <SelectField
          label={texts.state()}
          value={state ? name_of(state) : ''}
          change={(to) => (desk.chosen.value = to)}
          choices={choices}
        />
        <div class="row">
          <Button small icon="plus" disabled={desk.is_running.value} onClick={() => add('state')}>{texts.add_state()}</Button>
          <Button small icon="plus" disabled={desk.is_running.value} onClick={() => add('end')}>{texts.add_end()}</Button>
        </div>
      </div>
      {state ? <StateForm key={state.path} desk={desk} root={root} node={state} /> : <ScenarioForm desk={desk} root={root} />}
    </div>
  );
}

function name_of(node: Node): string {
  return (node.element.attribute('name') ?? '').trim();
}

function ScenarioForm({ desk, root }: { desk: Desk; root: Node }) {
  const of = (name: string) => root.children.filter((one) => one.name === name);
  return (
    <>
      <ElementFields desk={desk} root={root} node={root} />
      {(['component', 'variable'] as const).map((name) => (
        <section key={name} class="scenario-part">
          <h3>{name === 'component' ? texts.needed_components() : texts.variables()}</h3>
          {of(name).map((one) => <ElementCard key={one.path} desk={desk} root={root} node={one} />)}
          <Adder desk={desk} root={root} parent={root} names={[name]} />
        </section>
      ))}
    </>
  );
}

function StateForm({ desk, root, node }: { desk: Desk; root: Node; node: Node }) {
  const of = (names: readonly string[]) => node.children.filter((one) => names.includes(one.name));
  const cards = (names: readonly string[]) => of(names).map((one) => <ElementCard key={one.path} desk={desk} root={root} node={one} />);
  const adder = (names: readonly string[]) => (
    <Adder desk={desk} root={root} parent={node} names={names.filter((one) => may_add(node, one))} />
  );
  const remove = () => {
    desk.chosen.value = '';
    desk.edit(without(desk.text.value, node), '');
  };
  return (
    <>
      <ElementFields desk={desk} root={root} node={node} />
      {problems_at(desk.reading.value.problems, node).map((one) => <p key={one} class="field-error">{one}</p>)}
      {node.name === 'state' && (
        <section class="scenario-part">
          <h3>{texts.triggers()} <span class="scenario-soft">{texts.triggers_hint()}</span></h3>
          {cards(triggers)}
          {adder(triggers)}
        </section>
      )}
      <section class="scenario-part">
        <h3>{texts.on_entering()}</h3>
        {cards(entering)}
        {adder(entering)}
      </section>
      {node.name === 'state' && (
        <section class="scenario-part">
          <h3>{texts.on_leaving()}</h3>
          {cards(['leaving'])}
          {adder(['leaving'])}
        </section>
      )}
      <div>
        <Button small look="danger" disabled={desk.is_running.value} onClick={remove}>{texts.remove_state()}</Button>
      </div>
    </>
  );
}
