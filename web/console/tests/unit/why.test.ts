// Explanations of failed commands.
import { beforeEach, describe, expect, test } from 'vitest';

import { watched } from '../../src/forms/exchange';
import { why } from '../../src/forms/why';
import type { Console } from '../../src/state/console';
import type { CommandEntry } from '../../src/state/session/commands_state';
import { profile_xml, settled, World } from './world';

const map =
  '<floor_map xmlns="urn:x-rois:map:1" name="Hall" crs="hall"><bounds x="0" y="0" width="16000" depth="12000"/><furniture x="1000" y="1000" width="500" depth="500"/>' +
  '<place name="desk" x="0" y="0" heading="0" width="1" depth="1"/></floor_map>';

let world: World;
let console: Console;

beforeEach(async () => {
  world = new World();
  world.pages.set('/rois/map', { status: 200, text: map });
  world.answers.set('get_profile', () => profile_xml({ navigation: { type: 'Navigation' }, follow: { type: 'Follow' }, 'other.move': { type: 'Move', engine: 'other' } }));
  world.answers.set('execute', (request) => {
    const unit = request.child('CommandUnitSequence')!.child('command_unit_list')!;
    const [id, type] = ['command_id', 'command_type'].map((name) => unit.attributes.find((one) => one.name === name)!.value);
    const ref = unit.child('component_ref')!.attributes[0]!.value;
    const values = unit.child('arguments')?.all('parameter')[0]?.all('value').map((one) => `<rois:value>${one.text}</rois:value>`).join('') ?? '';
    const given = values === '' ? '' : `<rois:arguments><rois:parameter rois:name="target_position"><rois:data_type_ref rois:code="string[]"/>${values}</rois:parameter></rois:arguments>`;
    return `<rois:CommandUnitSequence><rois:command_unit_list xsi:type="rois:CommandMessageType" rois:command_type="${type}" rois:command_id="${id}"><rois:component_ref rois:code="${ref}"/>${given}</rois:command_unit_list></rois:CommandUnitSequence>`;
  });
  console = await world.console();
});

async function ended(ref: string, status: string, result = '', target?: string[]): Promise<CommandEntry> {
  world.answers.set('get_command_result', () => `<results><result rois:name="status"><rois:data_type_ref rois:code="string"/><rois:value>${status}</rois:value></result>${result}</results>`);
  const { command_ids } = await console.run(ref, 'start', target ? { target_position: target } : {});
  await settled();
  if (status !== 'RUNNING') await world.notifies('completed', `<command_id>${command_ids[0]}</command_id><status>${status}</status>`);
  return console.commands.find(command_ids[0]!)!;
}

describe('a command that failed', () => {
  test("has the engine's reason from the results", async () => {
    const entry = await ended('navigation', 'ERROR', '<result rois:name="reason"><rois:data_type_ref rois:code="string"/><rois:value>no way</rois:value></result>');
    expect(why(console, entry)).toEqual(['reason: no way']);
  });

  test('was sent to an unreachable place', async () => {
    const entry = await ended('navigation', 'ERROR', '', ['desk', '100, 200, 90', '20000, 5', '1200, 1200']);
    expect(why(console, entry)).toEqual(['20000, 5 is outside the map: x 0 … 16000, y 0 … 12000 (mm).', '1200, 1200 is inside furniture.']);
  });

  test('needs the same wheels as another component of its robot', async () => {
    await ended('navigation', 'RUNNING');
    await ended('other.move', 'RUNNING');
    const entry = await ended('follow', 'OUT_OF_RESOURCES');
    expect(why(console, entry)).toEqual(['Running on the same robot: navigation start.']);
  });

  test('ended while the engine reported an error of its component', async () => {
    world.answers.set('get_error_detail', () => '<results><result rois:name="description"><rois:data_type_ref rois:code="string"/><rois:value>the motor is hot</rois:value></result></results>');
    world.answers.set('get_command_result', () => '<results><result rois:name="status"><rois:data_type_ref rois:code="string"/><rois:value>ERROR</rois:value></result></results>');
    const { command_ids } = await console.run('navigation', 'start');
    await world.notifies('receive_error', '<error_id>e-1</error_id><error_type>COMPONENT_INTERNAL_ERROR</error_type><component_ref rois:code="navigation"/>');
    await world.notifies('completed', `<command_id>${command_ids[0]}</command_id><status>ERROR</status>`);
    expect(why(console, console.commands.find(command_ids[0]!)!)).toEqual(['The engine reported an error meanwhile: COMPONENT_INTERNAL_ERROR. description: the motor is hot']);
  });
});

describe('a request', () => {
  test('is found with its answer, even if a component is bound first', async () => {
    const outcome = await watched(console, 'execute', () => console.run('navigation', 'start'));
    expect(world.names().filter((name) => name === 'bind' || name === 'execute')).toEqual(['bind', 'execute']);
    expect([outcome.request?.name, outcome.answer?.name, outcome.error]).toEqual(['execute', 'execute_response', undefined]);
  });

  test('is missing if it was not sent', async () => {
    world.answers.set('bind', () => 'OUT_OF_RESOURCES');
    const outcome = await watched(console, 'execute', () => console.run('navigation', 'start'));
    expect([outcome.request, outcome.answer]).toEqual([undefined, undefined]);
    expect(outcome.error).toMatchObject({ failure: 'refused', return_code: 'OUT_OF_RESOURCES' });
  });
});
