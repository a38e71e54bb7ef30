// Reading the sample messages into objects.
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { test } from 'node:test';

import { component_profile_of, engine_profile_of, fault_of, is_notification, notification_of, parse_xml, read_stop_state, results_of } from 'rois-client';

import { identifier_of, profile_of, trouble_of } from '#dist/answers.js';

import { root } from '../kit/gateway.js';

const folder = `${root}/schemas/samples/valid`;
const sample = (name: string) => parse_xml(readFileSync(`${folder}/${name}.xml`, 'utf8'));

test('a fault gives its place if it has one', () => {
  const reason = 'There is no element "component" here; expected: component_ref.';
  assert.deepEqual(fault_of(sample('fault')), { code: 'invalid', reason, line: 2, column: 3 });
  assert.deepEqual(fault_of(sample('fault_without_place')), { code: 'no_session', reason: 'There is no such session.' });
});

test('a refused answer becomes an error that names the operation', () => {
  const trouble = trouble_of(sample('bind_response_failed'))!;
  assert.deepEqual([trouble.failure, trouble.return_code, trouble.message], ['refused', 'OUT_OF_RESOURCES', 'bind: OUT_OF_RESOURCES: Another session has "navigation" bound.']);
  assert.equal(trouble_of(sample('fault_without_place'))!.message, 'no_session: There is no such session.');
  for (const file of readdirSync(folder).filter((one) => one.endsWith('_response_failed.xml'))) assert.equal(trouble_of(sample(file.slice(0, -4)))!.failure, 'refused', file);
  for (const file of readdirSync(folder).filter((one) => one.endsWith('_response.xml'))) assert.equal(trouble_of(sample(file.slice(0, -4))), undefined, file);
  assert.throws(() => trouble_of(parse_xml('<bind_response/>')), { failure: 'protocol', message: /'bind_response' has no attribute 'return_code'/ });
});

test('notifications of all kinds are parsed', () => {
  const all = sample('notifications').children;
  assert.ok(all.every(is_notification));
  const [event, error, ...rest] = all.map(notification_of);
  const { results, ...others } = event as Extract<typeof event, { name: 'receive_event' }>;
  assert.deepEqual(others, {
    name: 'receive_event',
    sequence: 1,
    event_id: 'event-8',
    event_type: 'person_detected',
    subscribe_id: 's-1',
    expire: new Date('2026-11-20T12:01:00.123Z'),
    component_ref: { code: 'person_detection' },
  });
  assert.deepEqual([results.parameters, results.located], [[], []]);
  assert.deepEqual(error, { name: 'receive_error', sequence: 2, error_id: 'error-3', error_type: 'COMPONENT_INTERNAL_ERROR' });
  assert.deepEqual(rest, [
    { name: 'completed', sequence: 3, command_id: 'c-12', status: 'OK' },
    { name: 'lost', sequence: 5, count: 2 },
    { name: 'profile_changed', sequence: 6 },
  ]);
  const of_component = { name: 'receive_error', sequence: 2, error_id: 'error-3', error_type: 'COMPONENT_NOT_RESPONDING', component_ref: { code: 'navigation' } };
  assert.deepEqual(notification_of(sample('receive_error')), of_component);
  assert.deepEqual(notification_of(sample('switched')), {
    name: 'switched',
    sequence: 11,
    component_ref: { code: 'navigation' },
    from: 'robot1.navigation',
    to: 'robot2.navigation',
    reason: 'the link to the sub engine "robot1" was lost',
  });
  assert.ok(!is_notification(sample('bind_response')));
  assert.throws(() => notification_of(parse_xml('<bind_response sequence="1"/>')), { failure: 'protocol' });
  assert.throws(() => notification_of(parse_xml('<completed sequence="1"/>')), { failure: 'protocol', message: /'completed' has no 'command_id'/ });
});

test('a stop_state is parsed', () => {
  const state = (name: string) => read_stop_state(readFileSync(`${folder}/${name}.xml`, 'utf8'));
  assert.deepEqual(state('stop_state'), { stopped: true, not_halted: [] });
  assert.deepEqual(state('stop_state_not_halted'), { stopped: true, not_halted: ['navigation', 'robot2.move'] });
  assert.deepEqual(state('stop_state_cleared'), { stopped: false, not_halted: [] });
  assert.throws(() => state('fault'), { failure: 'protocol', message: /'fault' is not a stop_state/ });
  assert.throws(() => read_stop_state('<stop_state/>'), { failure: 'protocol', message: /'stop_state' has no 'stopped'/ });
  assert.throws(() => read_stop_state('stopped'), { failure: 'protocol', message: /the answer is not a stop_state document/ });
});

test('results include the positions of entities', () => {
  const results = results_of(sample('query_response'));
  assert.deepEqual(results.texts('robot_ref'), ['robot1', 'robot2', 'robot3']);
  assert.deepEqual(results.poses('position_data')[0], { x: 1200.5, y: -350, th: 92.5 });
  const [first, second, third] = results.located;
  const { covariance, ...rest } = first!;
  assert.deepEqual(rest, { of: 'position_data', ref: 'robot1', crs: 'urn:x-rois:def:crs:hall', position: [1200.5, -350, 0], orientation: [0, 0, 92.5] });
  assert.deepEqual([covariance!.length, covariance![0], covariance![21], covariance![35]], [36, 25, 1e-3, 2.5]);
  assert.deepEqual(second, { of: 'position_data', ref: 'robot2', crs: 'urn:x-rois:def:crs:hall', position: [0, 0, 0], reliability: 0.75 });
  assert.deepEqual(third, { of: 'position_data', ref: 'robot3', crs: '', position: [1, 2, 3] });
});

test('an identifier is parsed with all its attributes', () => {
  const all = { code: 'a', authority: 'b', codebook_ref: 'c', version: 'd' };
  const attributes = Object.entries(all).map(([name, text]) => `r:${name}="${text}"`);
  assert.deepEqual(identifier_of(parse_xml(`<i xmlns:r="http://www.omg.org/spec/RoIS/20240801" ${attributes.join(' ')}/>`)), all);
});

const int = { code: 'int' };

test('a component profile is parsed', () => {
  assert.deepEqual(component_profile_of(sample('component_profile')), {
    id: 'component_profile',
    identifier: 'urn:x-rois:def:component:example::PersonMonitor',
    name: 'person_monitor',
    description: '',
    sub_profiles: ['urn:x-rois:def:Component:OMG::PersonDetection', 'urn:x-rois:def:component:OMG::PersonLocalization'],
    messages: [
      { kind: 'event', name: 'person_disappeared', results: [], arguments: [] },
      {
        kind: 'command',
        name: 'count',
        results: [{ name: 'number', data_type_ref: int }],
        arguments: [{ name: 'max_number', data_type_ref: int, default_value: '10' }],
        timeout: 2000,
      },
      {
        kind: 'query',
        name: 'last_seen',
        results: [{ name: 'timestamp', data_type_ref: { code: 'DateTime' }, description: 'When somebody was seen last.' }],
        arguments: [],
      },
    ],
    parameters: [{ name: 'max_number', data_type_ref: int, default_value: '10' }],
  });
  assert.throws(() => component_profile_of(parse_xml('<p g:id="p" xmlns:g="http://www.opengis.net/gml/3.2"><MessageProfile/></p>')), { failure: 'protocol', message: /has no type/ });
});

test('an engine profile is parsed with its sub engines', () => {
  const robot = (name: string, given: string, sub_engines: object[], ...components: string[]) =>
    ({ id: `engine.${name}`, identifier: `urn:x-rois:def:HRIEngine:example::${name}`, name: given, sub_engines, components, parameters: [] });
  const navigation = 'urn:x-rois:def:HRIComponent:example::navigation';
  const house = engine_profile_of(sample('engine_profile_with_sub_profile'));
  assert.deepEqual(house.sub_engines, [
    robot('robot1', 'robot1', [], navigation),
    robot('robot2', '', [robot('arm', '', [], 'reaction')], navigation),
  ]);
  assert.deepEqual(house.components, ['person_detection', 'person_localization']);
  const data_type_ref = { code: 'urn:x-rois:def:DataType:ATR::Integer', authority: 'ATR' };
  assert.deepEqual(house.parameters, [{ name: 'max_number', data_type_ref, default_value: '10', description: 'How many people are counted.' }]);
});

test('get_profile returns the engine, the components and their profiles', () => {
  const { engine, components, component_profiles } = profile_of(sample('get_profile_response'));
  assert.equal(engine.id, 'engine.reception');
  assert.deepEqual(components[1], { ref: 'move', type: 'urn:x-rois:def:component:OMG::Move', engine: 'reception' });
  assert.deepEqual(component_profiles.map((one) => one.id), ['profile.person_detection', 'profile.move']);
});
