// Simulated visitors: commands to the engine and its answers.
import type { XmlElement } from 'rois-client';
import { beforeEach, describe, expect, test } from 'vitest';

import type { Console } from '../../src/state/console';
import { profile_xml, settled, World } from './world';

let world: World;
let console: Console;

const hall_urn = 'urn:x-rois:def:component:simulation::Hall';
const hall_profile =
  `<rois:HRIEngineProfile gml:id="engine.hall"><gml:identifier>urn:e</gml:identifier><gml:name>hall</gml:name><rois:HRIComponent>simulated_hall</rois:HRIComponent></rois:HRIEngineProfile>` +
  `<components><component ref="simulated_hall" type="${hall_urn}" engine="hall"/></components>` +
  `<rois:HRIComponentProfile gml:id="profile.simulated_hall"><gml:identifier>${hall_urn}</gml:identifier><gml:name>simulated_hall</gml:name></rois:HRIComponentProfile>`;

beforeEach(async () => {
  world = new World();
  world.answers.set('get_profile', () => hall_profile);
  world.answers.set('execute', echo);
  world.answers.set('get_command_result', () => `<results>${result('status', 'string', 'RUNNING')}</results>`);
  world.pages.set('/rois/map', { status: 404, text: '' });
  console = await world.console();
});

function result(name: string, type: string, ...values: string[]): string {
  return `<result rois:name="${name}"><rois:data_type_ref rois:code="${type}"/>${values.map((one) => `<rois:value>${one}</rois:value>`).join('')}</result>`;
}

const attribute_of = (element: XmlElement, name: string) => element.attributes.find((one) => one.name === name)?.value ?? '';

function units(): XmlElement[] {
  return world.requests.filter((one) => one.name === 'execute').map((one) => one.child('CommandUnitSequence')!.children[0]!);
}

function echo(request: XmlElement): string {
  const unit = request.child('CommandUnitSequence')!.children[0]!;
  const given = (unit.child('arguments')?.children ?? []).map((one) => `<rois:parameter rois:name="${attribute_of(one, 'name')}"><rois:data_type_ref rois:code="string"/>${one.all('value').map((each) => `<rois:value>${each.text}</rois:value>`).join('')}</rois:parameter>`);
  return `<rois:CommandUnitSequence><rois:command_unit_list xsi:type="rois:CommandMessageType" rois:command_type="${attribute_of(unit, 'command_type')}" rois:command_id="${attribute_of(unit, 'command_id')}"><rois:component_ref rois:code="simulated_hall"/><rois:arguments>${given.join('')}</rois:arguments></rois:command_unit_list></rois:CommandUnitSequence>`;
}

function sent_commands(): string[] {
  return units().map((unit) => `${attribute_of(unit, 'command_type')} ${(unit.child('arguments')?.children ?? []).map((one) => `${attribute_of(one, 'name')}=${one.all('value').map((each) => each.text).join('|')}`).join(' ')}`);
}

async function completes(status = 'OK', nth = -1): Promise<void> {
  await world.notifies('completed', `<command_id>${attribute_of(units().at(nth)!, 'command_id')}</command_id><status>${status}</status>`);
  await settled();
}

describe('the hall', () => {
  test('is found by the type of its component', async () => {
    expect(console.hall.component.value?.ref).toBe('simulated_hall');
    const other = new World();
    other.answers.set('get_profile', () => profile_xml({ navigation: { type: 'Navigation' } }));
    other.pages.set('/rois/map', { status: 404, text: '' });
    const without = await other.console();
    expect(without.hall.component.value).toBeUndefined();
    await expect(without.hall.leave('anna')).rejects.toThrow('this engine has no simulated hall');
    const stop = without.hall.poll.watch();
    expect(other.names()).not.toContain('query');
    stop();
  });

  test('sends orders to visitors, and binds the component during them', async () => {
    const { hall } = console;
    const all = [
      hall.enter('anna', { language: 'ja', known: true }), hall.enter('ben'), hall.walk('anna', 'desk'), hall.walk('anna', { x: 1000, y: 2000 }), hall.walk('anna', { x: 1, y: 2, th: 90 }),
      hall.say('anna', 'Hello', 'en'), hall.gesture('anna', 'wave'), hall.leave('anna'), hall.let_pass(1009),
    ];
    await settled();
    await settled();
    expect(sent_commands()).toEqual([
      'enter visitor_ref=anna language=ja known=true', 'enter visitor_ref=ben', 'walk visitor_ref=anna target_position=desk', 'walk visitor_ref=anna target_position=1000, 2000',
      'walk visitor_ref=anna target_position=1, 2, 90', 'say visitor_ref=anna text=Hello language=en', 'gesture visitor_ref=anna gesture=wave', 'leave visitor_ref=anna', 'let_pass time=1000',
    ]);
    expect(hall.orders_of('anna').map((one) => one.command_type)).toEqual(['enter', 'walk', 'walk', 'walk', 'say', 'gesture', 'leave']);
    expect([hall.awaited(), hall.is_taken('ben'), hall.is_taken('chika')]).toEqual([['anna', 'ben'], true, false]);
    for (let i = 0; i < all.length; ++i) await completes('OK', i);
    expect(hall.awaited()).toEqual([]);
    expect(await Promise.all(all)).toEqual(all.map(() => ({ status: 'OK', reason: '' })));
    expect(world.names().filter((one) => one === 'bind' || one === 'release')).toContain('release');
    expect([...console.bindings.mine.value]).toEqual([]);
  });

  test('reports why an order failed', async () => {
    const ordered = console.hall.walk('anna', 'desk');
    await settled();
    world.answers.set('get_command_result', () => `<results>${result('status', 'string', 'ERROR')}${result('reason', 'string', 'no way leads there')}</results>`);
    await completes('ERROR');
    expect(await ordered).toEqual({ status: 'ERROR', reason: 'no way leads there' });
  });

  test('is polled while watched', async () => {
    world.answers.set('query', () => `<component_ref rois:code="simulated_hall"/><results>${result('visitor_ref', 'string[]', 'anna', 'tanaka')}${result('position_data', 'string[]', '1000, 2000, 90', '5, 6, -90')}${result('known', 'bool[]', 'false true')}${result('steered', 'bool[]', 'true false')}</results>`);
    expect(console.hall.reported_at).toBe(0);
    const stop = console.hall.poll.watch();
    await settled();
    expect(console.hall.reported_at).toBe(world.now());
    expect([...console.hall.visitors.values()]).toEqual([
      { ref: 'anna', x: 1000, y: 2000, th: 90, known: false, steered: true },
      { ref: 'tanaka', x: 5, y: 6, th: -90, known: true, steered: false },
    ]);
    world.draws();
    const { beat } = console.hall.pulse;
    const before = beat.value;
    await world.passes(300);
    world.draws();
    expect(beat.value).toBe(before); // nothing has moved
    stop();
  });

  test('is polled less often at rest', async () => {
    let x = 1000;
    world.answers.set('query', () => `<component_ref rois:code="simulated_hall"/><results>${result('visitor_ref', 'string[]', 'anna')}${result('position_data', 'string[]', `${x}, 2000, 90`)}</results>`);
    const stop = console.hall.poll.watch();
    const asked_in = async (ms: number) => {
      const before = world.names().filter((one) => one === 'query').length;
      await world.passes(ms);
      return world.names().filter((one) => one === 'query').length - before;
    };
    await asked_in(4000);
    expect(await asked_in(6000)).toBeLessThanOrEqual(6);
    x = 1500;
    await asked_in(1050);
    expect(await asked_in(1500)).toBe(10); // anna moves
    await asked_in(3000);
    expect(await asked_in(6000)).toBeLessThanOrEqual(6);
    void console.hall.walk('anna', 'desk');
    await settled();
    expect(await asked_in(1500)).toBe(10);
    stop();
  });

  test("the engine's profile states whether time is stopped", () => {
    const profile = console.profile.profile.value!;
    const stands_still_at = (speed: string) => {
      const parameters = [{ name: 'sim_speed', data_type_ref: { code: 'double' }, default_value: speed, description: '' }];
      console.profile.update({ ...profile, engine: { ...profile.engine, parameters } }, 0);
      return console.hall.stands_still.value;
    };
    expect(console.hall.stands_still.value).toBe(false);
    expect([stands_still_at('0'), stands_still_at('1'), stands_still_at('0.5')]).toEqual([true, false, false]);
    expect(units()).toEqual([]); // no request was sent
  });
});
