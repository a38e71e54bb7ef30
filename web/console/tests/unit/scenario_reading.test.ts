// Scenarios as texts: validation, editing and layout.
import { readFileSync } from 'node:fs';

import { describe, expect, test } from 'vitest';

import { language } from '../../src/i18n/i18n';
import { graph_of, label_of_edge } from '../../src/scenario/graph';
import { layout_of } from '../../src/scenario/layout';
import { read_scenario } from '../../src/scenario/read';
import { moved, type Node, nodes_in, plain_lines, read_source, with_attribute, with_child, with_state_renamed, with_text, without } from '../../src/scenario/source';

const reception = readFileSync(new URL('../../../../client-cpp/scenarios/reception.xml', import.meta.url), 'utf8');

function node_of(root: Node, path: string): Node | undefined {
  return [...nodes_in(root)].find((one) => one.path === path);
}

function scenario_with(states: string, start = 'a'): string {
  return `<robot_scenario xmlns='urn:x-rois:scenario:1' start='${start}'>\n<component name='move'/>\n<variable name='x'/>\n${states}\n</robot_scenario>\n`;
}

function problems_of(text: string): string[] {
  return read_scenario(text).problems.map(({ say, line, column }) => `${line}:${column}: ${say()}`);
}

describe('reading', () => {
  test('accepts the included reception', () => {
    const { scenario, problems } = read_scenario(reception);
    expect(problems).toEqual([]);
    expect(scenario!.states.size).toBe(15);
    expect(scenario!.states.get('find')!.triggers[0]!.steps[0]).toEqual({ kind: 'take', variable: 'place', result: 'position_data', not_in: 'met', apart: 1500, beside: '', is: '' });
    expect(scenario!.states.get('approach_from_the_right')!.steps[0]).toEqual({ kind: 'place', variable: 'aim', before: '{place}', distance: 1000, turn: -60 });
    expect(scenario!.variables.get('identifying')).toBe('8');
  });

  test('reports all problems, and where a text is not well-formed', () => {
    expect(problems_of(scenario_with("<state name='a'><at_once to='c'/><at_once to='d'/></state>"))).toHaveLength(2);
    expect(problems_of('<robot_scenario>\n <a>')).toEqual(['2:5: <a> is not closed']);
  });

  test('reports in Japanese, too', () => {
    language.value = 'ja';
    expect(problems_of(scenario_with("<state name='a'><at_once to='c'/></state>"))).toEqual(["4:17: 状態 'c' はありません。あるもの: a"]);
    language.value = 'en';
  });
});

describe('changing', () => {
  const text = plain_lines(reception);
  const root = read_source(text);
  const state = (name: string) => [...nodes_in(root)].find((one) => one.name === 'state' && one.element.attribute('name') === name)!;

  // The changed lines.
  function difference(changed: string): string[] {
    const [before, after] = [text.split('\n'), changed.split('\n')];
    return [...before.filter((line) => !after.includes(line)).map((line) => `- ${line.trim()}`), ...after.filter((line) => !before.includes(line)).map((line) => `+ ${line.trim()}`)];
  }

  test('changing an attribute changes nothing else', () => {
    const after = state('find').children.find((one) => one.name === 'after')!;
    expect(difference(with_attribute(text, after, 'seconds', '3 & "4"'))).toEqual([
      '- <after seconds="{looking}" to="go_to_start_position"/>  <!-- the start overlooks the hall -->',
      '+ <after seconds="3 &amp; &quot;4&quot;" to="go_to_start_position"/>  <!-- the start overlooks the hall -->',
    ]);
    const [completed] = state('approach').children.filter((one) => one.name === 'completed');
    expect(difference(with_attribute(text, completed!, 'status', undefined))).toContain('+ <completed to="see_whether_they_stand"/>');
    const count = state('bow').children.at(-1)!.children[1]!;
    expect(difference(with_attribute(text, count, 'extra', '1'))).toEqual(['- <count variable="done"/>', '+ <count variable="done" extra="1"/>']);
  });

  test('texts are added, changed and removed', () => {
    const set = state('identify').children[0]!;
    const filled = with_text(text, set, 'a < b');
    expect(difference(filled)).toEqual(['- <set variable="visitor"/>', '+ <set variable="visitor">a &lt; b</set>']);
    expect(with_text(filled, node_of(read_source(filled), set.path)!, '')).toBe(text);
  });

  test('elements are added and removed with their lines', () => {
    const find = state('find');
    const added = with_child(text, find, '<after seconds="9" to="find"/>', find.children.at(-1));
    expect(difference(added)).toEqual(['+ <after seconds="9" to="find"/>']);
    expect(without(added, node_of(read_source(added), find.children.at(-1)!.path)!)).toBe(text);
    const end = root.children.at(-1)!;
    expect(with_child(text, root, '<end name="other"/>').slice(end.end)).toBe('\n  <end name="other"/>\n</robot_scenario>\n');
    const completed = state('answer').children.at(-1)!;
    expect(with_child(text, completed, '<count variable="done"/>')).toContain('    <completed to="bow">\n      <count variable="done"/>\n    </completed>\n');
  });

  test('siblings are swapped', () => {
    const approach = state('approach');
    const first = approach.children.findIndex((one) => one.name === 'completed');
    const once = moved(text, approach.children[first]!, 1);
    expect(read_scenario(once).scenario!.states.get('approach')!.triggers.map(({ to }) => to)).toEqual(['approach_from_the_left', 'see_whether_they_stand']);
    expect(moved(once, node_of(read_source(once), approach.children[first + 1]!.path)!, -1)).toBe(text);
  });

  test('renaming a state renames its references', () => {
    const renamed = read_scenario(with_state_renamed(text, root, 'go_to_start_position', 'go_home'));
    expect(renamed.problems).toEqual([]);
    expect(renamed.scenario!.states.get('bow')!.triggers[0]!.to).toBe('go_home');
  });

  test('comments, character references and CDATA do not change the positions of elements', () => {
    const odd = `<?xml version="1.0"?>\n<!-- <a> --><r a='1>2' b="&lt;">x<![CDATA[<c>]]><d/><!-- - --></r>`;
    const read = read_source(odd);
    expect([...nodes_in(read)].map((one) => odd.slice(one.start, one.end))).toEqual([odd.slice(odd.indexOf('<r')), '<d/>']);
  });
});

describe('drawing', () => {
  const graph = graph_of(read_scenario(reception).scenario!);
  const sizes = { box: (name: string) => ({ width: 40 + name.length * 6, height: 30 }), label: () => ({ width: 90, height: 16 }) };

  test('an edge has all triggers from one state to another', () => {
    const edge = graph.edges.find((one) => one.from === 'check_what_to_guide' && one.to === 'say_message')!;
    expect(label_of_edge(edge)).toBe('at once ×3');
    expect(graph.edges.filter((one) => one.from === 'find').map(label_of_edge)).toEqual(['person_localized', 'after {looking} s']);
  });

  test('nothing overlaps, and the order is from above', () => {
    const { boxes, edges, width, height } = layout_of(graph, sizes);
    const all = [...boxes.values(), ...edges.map((one) => one.label)];
    for (const [i, a] of all.entries())
      for (const b of all.slice(i + 1))
        expect(Math.abs(a.x - b.x) >= (a.width + b.width) / 2 || Math.abs(a.y - b.y) >= (a.height + b.height) / 2).toBe(true);
    for (const { x, y, width: w, height: h } of all) {
      expect(x - w / 2 >= 0 && x + w / 2 <= width).toBe(true);
      expect(y - h / 2 >= 0 && y + h / 2 <= height).toBe(true);
    }
    const rows = ['check_presence', 'find', 'approach', 'identify', 'ask', 'answer', 'bow', 'go_to_start_position', 'all_received'].map((name) => boxes.get(name)!.y);
    expect(rows).toEqual([...rows].sort((a, b) => a - b));
  });

  test('is deterministic, and handles loops and unreachable states', () => {
    expect(layout_of(graph, sizes)).toEqual(layout_of(graph, sizes));
    const odd = graph_of(read_scenario(scenario_with("<state name='a'><after seconds='1' to='a'/></state><state name='c'><at_once to='a'/></state><end name='b'/>")).scenario!);
    expect([...layout_of(odd, sizes).boxes.keys()]).toEqual(['a', 'c', 'b']);
  });
});
