// The cases of tests/scenarios, which also run against `rois scenario`.
import { describe, expect, test } from 'vitest';

import { desk_of } from '../../src/scenario/desk';
import { read_scenario } from '../../src/scenario/read';
import { cases_of, end_of, Engine, history_of } from './scenario_engine';
import { settled } from './world';

describe('a run', () => {
  test.each(cases_of('runs.json'))('$name', async ({ one, text }) => {
    const engine = new Engine(one.script);
    const console = await engine.world.console();
    const desk = desk_of(console);
    desk.open('case.xml', text);
    expect(desk.reading.value.problems).toEqual([]);
    void desk.start();
    for (let i = 0; i < 20; ++i) await settled(); // until its first state waits
    let requests = 0;
    for (const step of one.script) {
      if ('execute' in step || 'query' in step) await engine.receives(++requests);
      else await engine.does(step, desk);
    }
    for (let i = 0; i < 20 && desk.is_running.value; ++i) await settled();
    expect(history_of(desk)).toEqual(one.history);
    if (one.end.startsWith('error: ')) expect(end_of(desk)).toContain(one.end.slice('error: '.length));
    else expect(end_of(desk)).toBe(one.end);
    if (one.subscribed) expect([...engine.subscriptions.keys()].sort()).toEqual(one.subscribed);
    if (one.bound) expect(engine.bound).toEqual(one.bound);
    expect(console.bindings.mine.value.size).toBe(0);
  });
});

describe('a wrong document', () => {
  test.each(cases_of('documents.json'))('$name', ({ one, text }) => {
    const { scenario, problems } = read_scenario(text);
    expect(scenario).toBeUndefined();
    const [first] = problems.map(({ say, line, column }) => `${line}:${column}: ${say()}`);
    expect(first!.slice(0, one.problem.length)).toBe(one.problem);
  });
});
