// The members of logical components: which act now, their switches, and how panels show them.
import { beforeEach, describe, expect, test } from 'vitest';

import { goals_of } from '../../src/map/goals';
import { MapSession } from '../../src/map/session';
import { summary } from '../../src/messages/summary';
import type { Console } from '../../src/state/console';
import { profile_xml, settled, World } from './world';

const query = (name: string) => `<rois:MessageProfile xsi:type="rois:QueryMessageProfileType" rois:name="${name}"/>`;
const identifier = (ref: string, type: string) => `<component_ref rois:code="${ref}" rois:codebook_ref="urn:x-rois:def:component:OMG::${type}"/>`;
const switched = '<component_ref rois:code="navigation"/><from>robot1.navigation</from><to>robot2.navigation</to><reason>the link was lost</reason>';
const of_robots = ['robot1.navigation', 'robot2.navigation'];

let world: World;
let console: Console;

function robot_at(ref: string, x: number): string {
  const result = (name: string, value: string, codebook = '') =>
    `<result rois:name="${name}"><rois:data_type_ref rois:code="string[]" rois:codebook_ref="${codebook}"/><rois:value>${value}</rois:value></result>`;
  return `<component_ref rois:code="${ref}.system_information"/><results>${result('robot_ref', ref)}${result('position_data', `${x}, 0, 0`, 'hall')}</results>`;
}

// Makes /metrics name these components as bound, and reads it.
async function bound(...refs: string[]): Promise<void> {
  world.pages.set('/metrics', { status: 200, text: refs.map((ref) => `rois_component_bound{component_ref="${ref}",session="7"} 1`).join('\n') });
  await world.passes(1000);
  console.metrics.poll.now();
  await settled();
}

beforeEach(async () => {
  world = new World();
  world.answers.set('get_profile', () =>
    profile_xml({
      navigation: { type: 'Navigation' },
      person_detection: { type: 'PersonDetection' },
      'robot1.system_information': { type: 'SystemInformation', engine: 'robot1', messages: query('robot_position') },
      'robot2.system_information': { type: 'SystemInformation', engine: 'robot2', messages: query('robot_position') },
    }),
  );
  const found = [
    ...of_robots.map((ref) => identifier(ref, 'Navigation')),
    ...['robot1', 'robot2'].map((robot) => identifier(`${robot}.person_detection`, 'PersonDetection')),
    identifier('robot1.system_information', 'SystemInformation'),
    identifier('lift.navigation', 'Elevator'),
  ];
  world.answers.set('search', () => `<component_ref_list>${found.join('')}</component_ref_list>`);
  world.answers.set('query', (request) => (/robot1/.test(request.child('condition')?.children[0]?.children[0]?.child('Literal')?.text ?? '') ? robot_at('robot1', 1000) : robot_at('robot2', 5000)));
  console = await world.console();
  console.metrics.poll.watch();
  await settled();
});

describe('members', () => {
  test('are the hidden components of the same name and type', () => {
    expect(console.members.of('navigation')).toEqual(of_robots);
    expect(console.members.of('robot1.system_information')).toEqual([]);
    expect([...console.members.all.value.keys()]).toEqual(['navigation', 'person_detection']);
  });

  test('are none if the engine rejects the search', async () => {
    world.answers.set('search', () => 'BAD_PARAMETER');
    await world.notifies('profile_changed');
    await settled();
    expect(console.members.of('navigation')).toEqual([]);
  });

  test('act while they and their logical component are bound, but not for a component bound by its ref', async () => {
    await bound('robot1.navigation');
    expect(console.members.acting_for('navigation')).toEqual([]);
    await bound('navigation', 'robot1.navigation');
    expect(console.members.acting_for('navigation')).toEqual(['robot1.navigation']);
    await console.bindings.bind('robot1.navigation');
    expect(console.members.acting_for('navigation')).toEqual([]);
  });

  test('of a component that senses act together, which marks no unit', async () => {
    await bound('person_detection', 'robot1.person_detection', 'robot2.person_detection', 'navigation', 'robot2.navigation');
    expect(console.members.acting_for('person_detection')).toHaveLength(2);
    expect(console.members.acts_for('robot1.system_information')).toEqual([]);
    expect(console.members.acts_for('robot2.system_information')).toEqual(['navigation']);
  });
});

describe('a switch', () => {
  test('is requested for all components, recorded, and shown at once', async () => {
    expect(world.requests[0]!.attribute('switches')).toBe('true');
    await bound('navigation', 'robot1.navigation');
    world.pages.delete('/metrics'); // an unreachable page must not hide the switch
    await world.notifies('switched', switched);
    expect(console.events.switches.at(0)!.switched).toMatchObject({ from: 'robot1.navigation', to: 'robot2.navigation' });
    expect(console.members.acting_for('navigation')).toEqual(['robot2.navigation']);
    expect(summary(console.documents.ring.last!)).toBe('robot1.navigation → robot2.navigation: the link was lost');
    await bound('navigation', 'robot1.navigation'); // chosen for a later command
    expect(console.members.acting_for('navigation')).toEqual(['robot1.navigation']);
  });

  test('moves the mark and the goal to the other robot', async () => {
    const session = new MapSession(console);
    console.robots.poll.watch();
    await settled();
    const marked = () => session.scene().shown.filter(({ acts_for }) => acts_for!.length > 0).map(({ name }) => name);
    const robot_of_goal = () => goals_of(console, session.scene().shown)[0]?.robot?.ref;
    const target = '<rois:parameter rois:name="target_position"><rois:data_type_ref rois:code="string[]"/><rois:value>9000, 0</rois:value></rois:parameter>';
    const unit = `<rois:component_ref rois:code="navigation"/><rois:arguments>${target}</rois:arguments>`;
    const sequence = `<rois:command_unit_list xsi:type="rois:CommandMessageType" rois:command_type="start" rois:command_id="go">${unit}</rois:command_unit_list>`;
    world.answers.set('execute', () => `<rois:CommandUnitSequence>${sequence}</rois:CommandUnitSequence>`);
    await console.run('navigation', 'start');
    await bound('navigation', 'robot1.navigation');
    expect([marked(), robot_of_goal()]).toEqual([['robot1'], 'robot1']);
    await world.notifies('switched', switched);
    expect([marked(), robot_of_goal()]).toEqual([['robot2'], 'robot2']);
  });
});
