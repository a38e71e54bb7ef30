// The end of a person's presence, which localization does not report.
import { expect, test } from 'vitest';

import { profile_xml, World } from './world';

const event = (name: string) => `<rois:MessageProfile xsi:type="rois:EventMessageProfileType" rois:name="${name}"/>`;

function event_body(event_type: string, component: string, results: string): string {
  return `<event_id>e</event_id><event_type>${event_type}</event_type><subscribe_id>s-1</subscribe_id><expire>2026-11-20T12:01:00Z</expire><component_ref rois:code="${component}"/><results>${results}</results>`;
}

function people(component: string, ...refs: string[]): string {
  const located = refs.map((ref) => `<located of="position_data" ref="${ref}" crs="hall"><position>1000 2000 0</position></located>`);
  return event_body('person_localized', component, `<result rois:name="person_ref"><rois:data_type_ref rois:code="RoISIdentifier[]"/></result>${located.join('')}`);
}

function number(component: string, n: number): string {
  return event_body('person_detected', component, `<result rois:name="number"><rois:data_type_ref rois:code="int"/><rois:value>${n}</rois:value></result>`);
}

test('events without results make people unknown, not out of sight, until results arrive', async () => {
  const world = new World();
  world.answers.set('get_profile', () => profile_xml({ localization: { type: 'PersonLocalization', messages: event('person_localized') } }));
  const console = await world.console();
  console.entities.watch();
  await world.notifies('receive_event', people('localization', 'person-1'));
  const bare = event_body('person_localized', 'localization', '');
  await world.notifies('receive_event', bare); // the same event again, for a subscriber without results
  const person = () => console.entities.all.get('person person-1')!;
  expect([person().is_seen, person().unknown_since]).toEqual([true, undefined]);
  await world.passes(2000);
  await world.notifies('receive_event', bare);
  expect(person()).toMatchObject({ is_seen: true, unknown_since: world.now() });
  expect(console.entities.is_blind()).toBe(true);
  await world.notifies('receive_event', people('localization', 'person-1'));
  expect(person().unknown_since).toBeUndefined();
});

test('when detection reports no persons, those of the same robot are out of sight', async () => {
  const world = new World();
  const parts = { PersonDetection: event('person_detected'), PersonLocalization: event('person_localized') };
  const components = Object.entries(parts).flatMap(([type, messages]) => ['', 'robot2.'].map((prefix) => [prefix + type, { type, messages, engine: prefix === '' ? 'hall' : 'robot2' }] as const));
  world.answers.set('get_profile', () => profile_xml(Object.fromEntries(components)));
  const console = await world.console();
  console.entities.watch();
  await world.notifies('receive_event', people('PersonLocalization', 'person-1'));
  await world.notifies('receive_event', people('robot2.PersonLocalization', 'person-2'));
  const seen = () => [...console.entities.all.values()].filter((one) => one.is_seen).map((one) => one.ref);
  await world.notifies('receive_event', number('PersonDetection', 1));
  expect(seen()).toEqual(['person-1', 'person-2']);
  await world.notifies('receive_event', number('PersonDetection', 0));
  expect(seen()).toEqual(['person-2']);
  await world.passes(31_000);
  expect([...console.entities.all.keys()]).toEqual(['person person-2']);
});
