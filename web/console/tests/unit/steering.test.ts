// The Visitors panel's own logic.
import { beforeEach, describe, expect, test, vi } from 'vitest';

import type { Console } from '../../src/state/console';
import { steering_of } from '../../src/visitors/steering';
import { profile_xml, settled, World } from './world';

let world: World;
let console: Console;

beforeEach(async () => {
  world = new World();
  world.answers.set('get_profile', () => profile_xml({ simulated_hall: { type: 'Hall' } }));
  world.pages.set('/rois/map', { status: 404, text: '' });
  console = await world.console();
});

function somebody(ref: string): void {
  console.hall.visitors.set(ref, { ref, x: 0, y: 0, th: 0, known: false, steered: true });
}

describe('steering', () => {
  test('proposes unused names', () => {
    const steering = steering_of(console);
    expect(steering_of(console)).toBe(steering);
    expect(steering.next_name()).toBe('anna');
    somebody('anna');
    expect(steering.next_name()).toBe('ben');
    for (const ref of ['ben', 'chika', 'daniel', 'emi', 'farid', 'grace', 'hiro']) somebody(ref);
    expect(steering.next_name()).toBe('anna2');
  });

  test('lets a visitor in under the typed or proposed name, and selects the visitor', () => {
    const enter = vi.spyOn(console.hall, 'enter').mockResolvedValue({ status: 'OK', reason: '' });
    const steering = steering_of(console);
    steering.enter();
    expect([steering.chosen.value, enter.mock.lastCall]).toEqual(['anna', ['anna', { language: 'en', known: false }]]);
    steering.name.value = ' tanaka ';
    steering.is_known.value = true;
    steering.language.value = 'ja';
    steering.enter();
    expect([steering.chosen.value, steering.name.value, enter.mock.lastCall]).toEqual(['tanaka', '', ['tanaka', { language: 'ja', known: true }]]);
  });

  test.each([
    ['OK', '', []],
    ['ABORT', '', []], // replaced by another order
    ['ERROR', 'no way leads there', [['warning', 'anna could not: walking', 'no way leads there']]],
  ])('reports failed orders: %s', async (status, reason, expected) => {
    await steering_of(console).order('anna', 'walk', Promise.resolve({ status, reason }));
    expect(console.notices.list.value.map((one) => [one.severity, one.text, one.detail])).toEqual(expected);
  });

  test('time runs at real speed until it is halted or the engine refuses', async () => {
    const passed: number[] = [];
    const let_pass = vi.spyOn(console.hall, 'let_pass').mockImplementation((ms) => {
      passed.push(ms);
      return Promise.resolve({ status: 'OK', reason: '' });
    });
    const steering = steering_of(console);
    void steering.flow();
    await settled();
    await world.passes(450);
    expect(passed).toEqual([100, 100, 100, 100, 100]);
    steering.halt();
    await world.passes(450);
    expect([passed.length, steering.flows.value]).toEqual([5, false]);
    let_pass.mockRejectedValue(new Error('no'));
    void steering.flow();
    await settled();
    expect([steering.flows.value, console.notices.list.value.length]).toEqual([false, 1]);
  });
});
