// Editing in the Scenario panel's forms.
import { beforeEach, describe, expect, test } from 'vitest';

import { closed_choices, may_add, relation_of, steps_for, suggestions, unused, with_new, with_relation } from '../../src/scenario/editing';
import { actions, steps, triggers } from '../../src/scenario/grammar';
import { neighbour } from '../../src/scenario/picture';
import { read_scenario } from '../../src/scenario/read';
import { type Node, nodes_in, read_source } from '../../src/scenario/source';
import { views_of } from '../../src/state/engine/profile_state';

const text = `<robot_scenario xmlns="urn:x-rois:scenario:1" start="a">
  <component name="voice" type="SpeechSynthesis"/>
  <variable name="x"/>
  <variable name="list"/>
  <state name="a">
    <set variable="x">1</set>
    <command component="voice" type="start"><argument name="speech_text">hello</argument></command>
    <event type="person_detected" to="b">
      <take variable="x" result="number"/>
      <when variable="x" is="1"/>
    </event>
    <after seconds="1" to="b"/>
    <leaving><command component="voice" type="stop"/></leaving>
  </state>
  <end name="b"/>
</robot_scenario>
`;

let root: Node;
beforeEach(() => {
  root = read_source(text);
});
const first = (name: string, within = root) => [...nodes_in(within)].find((one) => one.name === name)!;

describe('a new element', () => {
  test.each([...triggers.filter((one) => one !== 'answered'), ...actions, 'command', 'query'])('a new %s goes to a valid place and is valid', (name) => {
    const changed = with_new(text, first('state'), name, root, 'a');
    expect(read_scenario(changed).problems).toEqual([]);
    expect(changed.length).toBeGreaterThan(text.length);
  });

  test.each(steps)('step %s of an event', (name) => {
    expect(read_scenario(with_new(text, first('event'), name, root, 'a')).problems).toEqual([]);
  });

  test('states, ends, components and variables get unused names', () => {
    for (const name of ['state', 'end', 'component', 'variable']) expect(read_scenario(with_new(text, root, name, root, '')).problems).toEqual([]);
    expect(with_new(text, root, 'state', root, '')).toContain('\n  <state name="state_1">\n    <after seconds="5" to="a"/>\n  </state>\n</robot_scenario>');
    expect(unused(['state_1'], 'state')).toBe('state_2');
  });

  test("keeps the document's prefix", () => {
    const prefixed = text.replaceAll('</', '</s:').replaceAll(/<(?=\w)/g, '<s:').replace('xmlns=', 'xmlns:s=');
    const own = read_source(prefixed);
    expect(with_new(prefixed, first('leaving', own).parent!, 'after', own, 'a')).toContain('<s:after seconds="5" to="b"/>');
    expect(read_scenario(with_new(prefixed, own, 'state', own, '')).problems).toEqual([]);
  });

  test('is not offered where it is not allowed', () => {
    expect(may_add(first('state'), 'leaving')).toBe(false);
    expect(may_add(first('state'), 'query')).toBe(true);
    expect(may_add(first('end'), 'command')).toBe(false);
    expect(steps_for(first('after'))).not.toContain('take');
  });
});

describe('conditions', () => {
  const turned = (from: string, to: Parameters<typeof with_relation>[2]) => {
    const changed = text.replace('is="1"/>', `${from}/>`);
    const after = with_relation(changed, first('when', read_source(changed)), to, read_source, 'list');
    return /<when variable="x" ([^/]*)\/>/.exec(after)![1];
  };
  test.each([
    ['is="1"', 'is_not', 'is_not="1"'],
    ['is="1"', 'in', 'in="list"'],
    ['in="list"', 'not_in', 'not_in="list"'],
    ['in="list"', 'is', 'is=""'],
    ['is="1"', 'empty', 'empty="true"'],
    ['empty="false"', 'is', 'is=""'],
    ['is="{x}"', 'near', 'near="{x}" within="500"'],
    ['near="0, 0" within="7"', 'is', 'is="0, 0"'],
  ] as const)('%s turned into %s', (from, to, expected) => expect(turned(from, to)).toBe(expected));

  test('of a `when` have a relation, of an event none', () => {
    expect(relation_of(first('when'))).toBe('is');
    expect(relation_of(first('event'))).toBeUndefined();
  });
});

describe('choices', () => {
  const message = (kind: 'command' | 'query' | 'event', name: string, results: string[] = [], given: string[] = []) => ({
    kind, name, results: results.map((one) => ({ name: one, data_type_ref: { code: 'string' } })), arguments: given.map((one) => ({ name: one, data_type_ref: { code: 'string' } })),
  });
  const profile = (ref: string, type: string, messages: ReturnType<typeof message>[]) => ({ id: `profile.${ref}`, identifier: `urn:${type}`, name: ref, description: '', sub_profiles: [], messages, parameters: [] });
  const views = views_of({
    engine: { id: 'engine.e', identifier: 'urn:e', name: 'e', sub_engines: [], parameters: [], components: ['speech', 'detection'] },
    components: [{ ref: 'speech', type: 'urn:SpeechSynthesis', engine: 'e' }, { ref: 'detection', type: 'urn:PersonDetection', engine: 'e' }],
    component_profiles: [profile('speech', 'SpeechSynthesis', [message('command', 'start', [], ['speech_text', 'volume'])]), profile('detection', 'PersonDetection', [message('event', 'person_detected', ['timestamp', 'number'])])],
  });
  const meant = (name: string) => (name === 'voice' ? views.find((one) => one.ref === 'speech') : undefined);

  test("are the scenario's names and the engine's", () => {
    expect(closed_choices('state', root)).toEqual(['a', 'b']);
    expect(closed_choices('variable', root)).toEqual(['x', 'list']);
    expect(closed_choices('text', root)).toBeUndefined();
    expect(suggestions(first('event'), 'type', views, meant)).toEqual(['person_detected']);
    expect(suggestions(first('command'), 'type', views, meant)).toEqual(['start']);
    expect(suggestions(first('argument'), 'name', views, meant)).toEqual(['speech_text', 'volume']);
    expect(suggestions(first('take'), 'result', views, meant)).toEqual(['number', 'timestamp']);
    expect(suggestions(first('component'), 'type', views, meant)).toEqual(['PersonDetection', 'SpeechSynthesis']);
    expect(suggestions(first('component'), 'ref', views, meant)).toEqual(['detection', 'speech']);
    expect(suggestions(first('set'), 'variable', views, meant)).toBeUndefined();
  });
});

test('arrow keys lead to the nearest state in their direction', () => {
  const box = (x: number, y: number) => ({ x, y, width: 80, height: 30 });
  const boxes = new Map([['top', box(200, 0)], ['left', box(100, 80)], ['right', box(320, 80)], ['bottom', box(200, 160)]]);
  expect(['ArrowDown', 'ArrowUp', 'ArrowLeft', 'Enter'].map((key) => neighbour(boxes, 'top', key))).toEqual(['bottom', undefined, 'left', undefined]);
  expect(neighbour(boxes, 'left', 'ArrowRight')).toBe('right');
  expect(neighbour(boxes, 'bottom', 'ArrowUp')).toBe('top');
});
