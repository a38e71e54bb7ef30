// The amount of drawing, counted rather than timed; and the map's commands: sending, following, observing.
import type { XmlElement } from 'rois-client';
import { beforeEach, describe, expect, test, vi } from 'vitest';

import { drivers_of, follow, go, motions_of, stop } from '../../src/map/driving';
import { goals_of } from '../../src/map/goals';
import { Drawing, type Sheet } from '../../src/map/painting/drawing';
import { frame_box, frames_of } from '../../src/map/painting/ground';
import type { Palette } from '../../src/map/painting/palette';
import { Pen } from '../../src/map/painting/pen';
import { knob_distance } from '../../src/map/painting/picture';
import { age } from '../../src/map/formats';
import { MapSession } from '../../src/map/session';
import type { Console } from '../../src/state/console';
import { profile_xml, settled, World } from './world';

const map = `<floor_map xmlns="urn:x-rois:map:1" name="Hall" crs="hall"><bounds x="0" y="0" width="20000" depth="12000"/>
  <wall x1="15000" y1="12000" x2="15000" y2="9600"/><furniture x="7500" y="10200" width="4000" depth="800"/>
  <place name="desk" x="9500" y="9300" heading="90" width="2000" depth="2000"/><robot name="robot1" radius="280"/></floor_map>`;
const event = (name: string) => `<rois:MessageProfile xsi:type="rois:EventMessageProfileType" rois:name="${name}"/>`;
const position_query = '<rois:MessageProfile xsi:type="rois:QueryMessageProfileType" rois:name="robot_position"/>';

let world: World;
let console: Console;
let session: MapSession;
let calls = 0;

// A canvas that counts calls.
function sheet(): Sheet {
  const context = new Proxy({} as Record<string, unknown>, {
    get: (target, name: string) => target[name] ?? ((): unknown => (++calls, name === 'measureText' ? { width: 40 } : undefined)),
    set: (target, name: string, value) => ((target[name] = value), true),
  });
  return { width: 0, height: 0, getContext: () => context as never };
}

function drawing(): Drawing {
  const palette = new Proxy({}, { get: () => 'black' }) as Palette;
  const made = new Drawing(console, session, sheet(), { make_sheet: sheet, read_palette: () => palette, theme: () => 'dark', age_text: age, distance_text: String });
  made.resize({ width: 800, height: 600 }, 2);
  return made;
}

function result(name: string, ...values: string[]): string {
  return `<results><result rois:name="${name}"><rois:data_type_ref rois:code="string[]"/>${values.map((one) => `<rois:value>${one}</rois:value>`).join('')}</result></results>`;
}

function where(x: number, y: number): string {
  return `${result('robot_ref', 'robot1').replace('</results>', '')}<result rois:name="position_data"><rois:data_type_ref rois:code="string[]" rois:codebook_ref="hall"/><rois:value>${x}, ${y}, 0</rois:value></result></results>`;
}

function people(...all: [x: number, y: number][]): string {
  const located = all.map(([x, y], i) => `<located of="position_data" ref="person-${i}" crs="hall"><position>${x} ${y} 0</position><orientation>0 0 90</orientation><covariance>2500 0 0 0 900 0 0 0 4</covariance></located>`);
  return `<event_id>e</event_id><event_type>person_localized</event_type><subscribe_id>s-1</subscribe_id><expire>2026-11-20T12:01:00Z</expire><component_ref rois:code="person_localization"/><results><result rois:name="person_ref"><rois:data_type_ref rois:code="RoISIdentifier[]" rois:codebook_ref="tracks"/></result>${located.join('')}</results>`;
}

// The components of an execute with their commands and arguments.
function asked(request: XmlElement): string[] {
  return request.child('CommandUnitSequence')!.children.map((unit) => {
    const ref = unit.child('component_ref')!.attributes[0]!.value;
    const type = unit.attributes.find((one) => one.name === 'command_type')!.value;
    const given = (unit.child('arguments')?.all('parameter') ?? []).map((one) => `${one.attributes.find(({ name }) => name === 'name')!.value}=${one.text_of('value')}`);
    return [ref, type, ...given].join(' ');
  });
}

function accepted(request: XmlElement): string {
  const units = request.child('CommandUnitSequence')!.children.map((unit) => {
    const of = (name: string) => unit.attributes.find((one) => one.name === name)?.value ?? '';
    const given = (unit.child('arguments')?.all('parameter') ?? []).map((one) => `<rois:parameter rois:name="${one.attributes.find(({ name }) => name === 'name')!.value}"><rois:data_type_ref rois:code="string[]"/><rois:value>${one.text_of('value')}</rois:value></rois:parameter>`);
    return `<rois:command_unit_list xsi:type="rois:CommandMessageType" rois:command_type="${of('command_type')}" rois:command_id="${of('command_id')}"><rois:component_ref rois:code="${unit.child('component_ref')!.attributes[0]!.value}"/><rois:arguments>${given.join('')}</rois:arguments></rois:command_unit_list>`;
  });
  return `<rois:CommandUnitSequence>${units.join('')}</rois:CommandUnitSequence>`;
}

function ids(): string[] {
  return world.requests.filter((one) => one.name === 'execute').map((one) => one.child('CommandUnitSequence')!.children[0]!.attributes.find(({ name }) => name === 'command_id')!.value);
}

function executed(): string[] {
  return world.requests.filter((one) => one.name === 'execute').flatMap(asked);
}

async function ends(id: string, status: string): Promise<void> {
  await world.notifies('completed', `<command_id>${id}</command_id><status>${status}</status>`);
}

beforeEach(async () => {
  world = new World();
  calls = 0;
  const parts = {
    system_information: { type: 'SystemInformation', messages: position_query, includes: [] },
    navigation: { type: 'Navigation' },
    follow: { type: 'Follow' },
    person_localization: { type: 'PersonLocalization', messages: event('person_localized') },
    sound_localization: { type: 'SoundLocalization', messages: event('sound_localized') },
  };
  world.answers.set('get_profile', () => profile_xml(parts));
  world.answers.set('get_command_result', () => result('status', 'RUNNING'));
  world.answers.set('execute', accepted);
  world.answers.set('query', () => `<component_ref rois:code="system_information"/>${where(1000, 2000)}`);
  world.pages.set('/rois/map', { status: 200, text: map });
  console = await world.console();
  session = new MapSession(console);
});

describe('drawing', () => {
  test('happens after changes, once a frame, and for the ground only when the view changes', async () => {
    console.robots.poll.watch();
    await settled();
    world.draws();
    const made = drawing();
    made.start();
    world.draws();
    world.draws();
    const { pictures, grounds } = made.counts;
    for (let i = 0; i < 10; ++i) world.draws();
    expect(made.counts).toMatchObject({ pictures, grounds });
    for (let i = 0; i < 5; ++i) await world.notifies('receive_event', people([1000 + i * 100, 1000]));
    world.draws(); // notifies watchers
    world.draws(); // draws
    expect(made.counts).toMatchObject({ pictures: pictures + 1, grounds });
    made.act({ kind: 'zoom', factor: 2 });
    world.draws();
    expect(made.counts.grounds).toBe(grounds + 1);
  });

  test('does not happen at rest despite noise, except for ages; and at once when the robot moves', async () => {
    let n = 0;
    const at = (x: number, y: number) => `<component_ref rois:code="system_information"/>${where(x, y).replace('</results>', '')}<located of="position_data" ref="robot1" crs="hall"><position>${x} ${y} 0</position><orientation>0 0 ${(n % 3) - 1}</orientation><covariance>64 0 0 64</covariance></located></results>`;
    world.answers.set('query', () => at(1000 + 10 * Math.sin((n += 1)), 2000 + 10 * Math.cos(3 * n)));
    console.robots.poll.watch();
    await settled();
    const made = drawing();
    made.start();
    const pictures_in = async (ms: number) => {
      const { pictures } = made.counts;
      for (let passed = 0; passed < ms; passed += 16) {
        await world.passes(16);
        world.draws();
      }
      return made.counts.pictures - pictures;
    };
    await pictures_in(5000);
    const asked = () => world.names().filter((name) => name === 'query').length;
    const before = asked();
    expect(await pictures_in(10_000)).toBe(0);
    expect(asked() - before).toBeLessThanOrEqual(21);
    await world.notifies('receive_event', people([4000, 4000]));
    await pictures_in(10_000);
    expect(made.counts.pictures).toBeGreaterThan(0);
    expect(await pictures_in(10_000)).toBeLessThanOrEqual(2); // ages of standing persons change in steps of 5 s
    let x = 1000;
    world.answers.set('query', () => at((x += 100), 2000));
    expect(await pictures_in(2000)).toBeGreaterThan(60);
  });

  test('of 20 people moving at 20 Hz costs a bounded number of calls, and the ground and trails once', async () => {
    const made = drawing();
    made.start();
    world.draws();
    await world.notifies('receive_event', people(...Array.from({ length: 20 }, (_, i): [number, number] => [i * 900, 1000])));
    world.draws();
    world.draws();
    const before = { ...made.counts };
    calls = 0;
    for (let picture = 0; picture < 60; ++picture) {
      if (picture % 3 === 0) await world.notifies('receive_event', people(...Array.from({ length: 20 }, (_, i): [number, number] => [i * 900 + picture * 3, 1000 + picture * 18])));
      await world.passes(16);
      world.draws();
    }
    expect(made.counts.pictures - before.pictures).toBeLessThanOrEqual(60);
    expect(made.counts.pictures - before.pictures).toBeGreaterThanOrEqual(55); // they move smoothly between poses
    expect(made.counts.grounds).toBe(before.grounds);
    expect(made.counts.trails).toBe(before.trails);
    expect(calls / 60 / 20).toBeLessThan(80); // canvas calls per person and frame
  });

  test('with reduced motion draws one frame for each report', async () => {
    const made = drawing();
    made.is_still = true;
    made.start();
    await world.notifies('receive_event', people([1000, 1000]));
    for (let i = 0; i < 3; ++i) world.draws();
    const { pictures } = made.counts;
    await world.passes(100);
    await world.notifies('receive_event', people([1300, 1000]));
    for (let i = 0; i < 5; ++i) world.draws();
    expect(made.counts.pictures).toBe(pictures + 1);
  });

  test('stops when it ends', async () => {
    const made = drawing();
    const end = made.start();
    world.draws();
    end();
    const { pictures } = made.counts;
    session.hovered.value = 'person person-0';
    await world.notifies('receive_event', people([1000, 1000]));
    for (let i = 0; i < 3; ++i) world.draws();
    expect(made.counts.pictures).toBe(pictures);
  });

  test('finds the thing under the pointer', async () => {
    console.robots.poll.watch();
    await settled();
    const made = drawing();
    await world.notifies('receive_event', people([5000, 5000]));
    made.resize({ width: 800, height: 600 }, 1);
    const { x, y, scale } = made.view;
    const at = (to: { x: number; y: number }) => ({ x: 400 + (to.x - x) * scale, y: 300 - (to.y - y) * scale });
    expect(made.hit(at({ x: 1000, y: 2000 }))).toEqual({ what: 'thing', key: 'robot robot1' });
    expect(made.hit(at({ x: 5000, y: 5100 }))).toEqual({ what: 'thing', key: 'person person-0' });
    expect(made.hit(at({ x: 9500, y: 9300 }))).toEqual({ what: 'place', name: 'desk', x: 9500, y: 9300, th: 90 });
    expect(made.hit(at({ x: 12_000, y: 4000 }))).toEqual({ what: 'floor' });
    made.act({ kind: 'target', target: { x: 12_000, y: 4000, th: 0 } });
    expect(made.hit(at({ x: 12_000, y: 4000 }))).toEqual({ what: 'target' });
    expect(made.hit({ x: at({ x: 12_000, y: 4000 }).x + 46, y: at({ x: 12_000, y: 4000 }).y })).toEqual({ what: 'target' });
  });
});

describe('driving', () => {
  const said = () => console.notices.list.value.map((one) => one.text);

  beforeEach(async () => {
    console.robots.poll.watch();
    await settled();
  });

  test('sends the robot and reports how it ended', async () => {
    const [driver] = drivers_of(console);
    expect(driver).toMatchObject({ name: 'robot1', navigation: 'navigation', follow: 'follow' });
    await go(console, driver!, { x: 4000, y: 3000, th: 90 }, 60_000);
    expect(executed()).toEqual(['navigation start target_position=4000, 3000, 90 time_limit=60000']);
    expect(said()).toEqual([]); // the map shows it
    expect(motions_of(console, driver!)).toHaveLength(1);
    await ends(ids()[0]!, 'OK');
    expect(said()).toEqual(['robot1 has reached x 4.00 m, y 3.00 m']);
    expect(world.names()).toContain('release');
  });

  test("sent to a person, it reports the person's name on arrival", async () => {
    const [driver] = drivers_of(console);
    await go(console, driver!, { x: 4000, y: 3000, whom: 'tanaka' }, 0);
    expect(goals_of(console, [])).toMatchObject([{ kind: 'go', x: 4000, y: 3000, text: 'tanaka' }]);
    await ends(ids()[0]!, 'OK');
    expect(said()).toEqual(['robot1 has reached tanaka']);
  });

  test('reports that it was stopped', async () => {
    const [driver] = drivers_of(console);
    await go(console, driver!, { x: 9500, y: 9300, th: 90, place: 'desk' }, 0);
    expect(executed()[0]).toBe('navigation start target_position=desk time_limit=0');
    void stop(console, driver!);
    await settled();
    expect(executed()[1]).toBe('navigation stop');
    await ends(ids()[0]!, 'ABORT');
    await ends(ids()[1]!, 'OK');
    expect(said()).toEqual(['robot1 was stopped']);
  });

  test('reports a failure, but not a replaced command', async () => {
    const [driver] = drivers_of(console);
    await go(console, driver!, { x: 1, y: 2 }, 0);
    await go(console, driver!, { x: 3, y: 4 }, 0);
    await ends(ids()[0]!, 'ABORT');
    expect(said()).toEqual([]);
    await ends(ids()[1]!, 'TIMEOUT');
    expect(console.notices.list.value).toMatchObject([{ severity: 'error', text: 'Not reached: x 0.00 m, y 0.00 m', detail: 'TIMEOUT' }]);
    world.answers.set('get_command_result', () => '<results><result rois:name="reason"><rois:data_type_ref rois:code="string"/><rois:value>a wall is in the way</rois:value></result></results>');
    await go(console, driver!, { x: 5, y: 6 }, 0); // a new command removes the notice of the last one
    expect(said()).toEqual([]);
    await ends(ids()[2]!, 'ERROR');
    await settled();
    expect(console.notices.list.value).toMatchObject([{ severity: 'error', detail: 'a wall is in the way' }]);
    vi.stubGlobal('history', { replaceState: () => undefined }); // the page's address
    console.notices.list.value[0]!.action!.act();
    vi.unstubAllGlobals();
    expect(console.documents.ring.numbered(console.selection.wanted.value!)).toMatchObject({ name: 'completed' });
  });

  test('follows by the permanent name, after stopping other motions', async () => {
    const [driver] = drivers_of(console);
    await go(console, driver!, { x: 1, y: 2 }, 0);
    await world.notifies('receive_event', people([5000, 5000]));
    console.entities.all.get('person person-0')!.identity = { ref: 'tanaka', codebook: 'visitors', at: 0 };
    const followed = follow(console, driver!, session.scene().shown.find((one) => one.name === 'tanaka')!, 1200);
    await settled();
    expect(executed().at(-1)).toBe('navigation stop');
    await ends(ids()[0]!, 'ABORT');
    await ends(ids()[1]!, 'OK');
    await followed;
    expect(executed().at(-1)).toBe('follow start target_object_ref=tanaka distance=1200');
    expect(goals_of(console, session.scene().shown)).toMatchObject([{ kind: 'follow', x: 5000, y: 5000, text: 'tanaka', is_mine: true }]);
    const stopped = stop(console, driver!);
    await settled();
    await ends(ids()[2]!, 'OK');
    await ends(ids()[3]!, 'OK');
    await stopped;
    expect(motions_of(console, driver!)).toEqual([]);
  });

  test('a goal is the place that was sent, by name or coordinates', async () => {
    const [driver] = drivers_of(console);
    await go(console, driver!, { x: 9500, y: 9300, place: 'desk' }, 0);
    expect(goals_of(console, [])).toMatchObject([{ kind: 'go', x: 9500, y: 9300, th: 90, text: 'desk', is_mine: true }]);
    await go(console, driver!, { x: 3000, y: 4000 }, 0);
    expect(goals_of(console, [])[0]).toMatchObject({ x: 3000, y: 4000 });
    expect(goals_of(console, [])[0]!.th).toBeUndefined();
  });

  test('a refused command rejects, and nothing stays bound', async () => {
    world.answers.set('execute', () => 'BAD_PARAMETER');
    const [driver] = drivers_of(console);
    await expect(go(console, driver!, { x: 1, y: 2 }, 0)).rejects.toMatchObject({ return_code: 'BAD_PARAMETER' });
    expect(console.bindings.mine.value.size).toBe(0);
    expect(said()).toEqual([]);
  });
});

test("a person's name is not drawn over a frame's name", async () => {
  const boxes: [x: number, y: number, width: number, height: number][] = [];
  const recording = sheet();
  const context = recording.getContext('2d') as unknown as Record<string, unknown>;
  context['roundRect'] = (x: number, y: number, width: number, height: number) => boxes.push([x, y, width, height]);
  const palette = new Proxy({}, { get: () => 'black' }) as Palette;
  const made = new Drawing(console, session, { ...recording, getContext: () => context as never }, { make_sheet: sheet, read_palette: () => palette, theme: () => 'dark', age_text: age, distance_text: String });
  made.resize({ width: 800, height: 600 }, 2);
  await settled();
  await world.notifies('receive_event', people([100, -300])); // its name would overlap the frame's
  boxes.length = 0;
  made.resize({ width: 800, height: 600 }, 2);
  const pen = new Pen(context as never, made.view, { width: 800, height: 600 }, palette);
  const taken = frame_box(pen, frames_of(session.map!)[0]!, 40);
  expect(boxes).toHaveLength(1);
  const [[x, y, width, height]] = boxes as [(typeof boxes)[0]];
  const is_over = x < taken.x + taken.width && taken.x < x + width && y < taken.y + taken.height && taken.y < y + height;
  expect(is_over).toBe(false);
});

test('of two robots the selected one is sent', async () => {
  const two = (name: string) => ({ [`${name}.system_information`]: { type: 'SystemInformation', engine: name, messages: position_query, includes: [] }, [`${name}.navigation`]: { type: 'Navigation', engine: name } });
  world = new World();
  world.answers.set('get_profile', () => profile_xml({ ...two('robot1'), ...two('robot2') }));
  world.answers.set('query', (request) => {
    const name = /robot\d/.exec(JSON.stringify(request))![0];
    return `<component_ref rois:code="${name}.system_information"/>${where(1000, 2000).replace('robot1', name)}`;
  });
  world.pages.set('/rois/map', { status: 200, text: map });
  console = await world.console();
  session = new MapSession(console);
  console.robots.poll.watch();
  await settled();
  const made = drawing();
  const drives = () => session.driver()?.name;
  expect(drives()).toBe('robot1');
  made.act({ kind: 'choose', key: 'robot robot2' });
  expect(drives()).toBe('robot2');
  made.act({ kind: 'target', target: { x: 5000, y: 5000 } }); // a click on the floor
  expect(drives()).toBe('robot2');
  made.act({ kind: 'choose', key: 'person tanaka' });
  expect(drives()).toBe('robot2');
  made.act({ kind: 'choose', key: 'robot robot1' });
  expect(drives()).toBe('robot1');
});

describe('observing', () => {
  async function ending(): Promise<void> {
    for (let known = -1; known !== ids().length; ) {
      known = ids().length;
      await ends(ids()[known - 1] ?? '', 'OK');
      await settled();
    }
  }

  test('binds and starts the detecting components, and releases them', async () => {
    const { observer } = session;
    const on = observer.turn_to(true);
    await settled();
    await ending();
    await on;
    expect(executed()).toEqual(['person_localization start', 'sound_localization start']);
    expect(observer.state.value).toMatchObject({ is_wanted: true, is_busy: false, on: ['person_localization', 'sound_localization'], refused: [] });
    expect([...console.bindings.mine.value]).toEqual(['person_localization', 'sound_localization']);
    await observer.turn_to(false);
    expect(console.bindings.mine.value.size).toBe(0);
    expect(observer.state.value).toMatchObject({ is_wanted: false, on: [] });
  });

  test('uses the available components and reports the others', async () => {
    world.answers.set('bind', (request) => (request.child('component_ref')!.attributes[0]!.value.startsWith('person') ? 'OUT_OF_RESOURCES' : ''));
    const on = session.observer.turn_to(true);
    await settled();
    await ending();
    await on;
    expect(session.observer.state.value).toMatchObject({ on: ['sound_localization'], refused: [{ ref: 'person_localization', error: { return_code: 'OUT_OF_RESOURCES' } }] });
  });

  test('does not stop what the user had started, or release what the user had bound', async () => {
    const started = console.run('person_localization', 'start');
    await settled();
    await ends(ids()[0]!, 'OK');
    await started;
    const on = session.observer.turn_to(true);
    await settled();
    await ending();
    await on;
    expect(executed()).toEqual(['person_localization start', 'sound_localization start']);
    await session.observer.turn_to(false);
    expect([...console.bindings.mine.value]).toEqual(['person_localization']);
    expect(executed()).toHaveLength(2);
  });

  test('is off when all components were released elsewhere', async () => {
    const on = session.observer.turn_to(true);
    await settled();
    await ending();
    await on;
    await console.bindings.release_all();
    expect(session.observer.state.value.is_wanted).toBe(false);
  });

  test('restarts components that were stopped for another user, and shows meanwhile that they do not work', async () => {
    const on = session.observer.turn_to(true);
    await settled();
    await ending();
    await on;
    const give_back = await console.bindings.borrow(['person_localization']); // for example by a scenario
    const stopped = await console.run('person_localization', 'stop', {}, { give_back: true });
    await ends(stopped.command_ids[0]!, 'OK');
    await stopped.ends;
    world.draws();
    await settled();
    expect(session.observer.state.value).toMatchObject({ is_wanted: true, on: ['sound_localization'] });
    expect(executed().slice(2)).toEqual(['person_localization stop']);
    await give_back();
    await world.passes(1000);
    await ending();
    expect(executed().slice(3)).toEqual(['person_localization start']);
    expect(session.observer.state.value).toMatchObject({ is_wanted: true, on: ['person_localization', 'sound_localization'], refused: [] });
    await session.observer.turn_to(false);
    expect(console.bindings.mine.value.size).toBe(0);
  });

  test('does not restart what the user has stopped, and shows that it does not work', async () => {
    const on = session.observer.turn_to(true);
    await settled();
    await ending();
    await on;
    const stopped = await console.run('person_localization', 'stop');
    await ends(stopped.command_ids[0]!, 'OK');
    world.draws();
    await world.passes(2000);
    expect(executed().slice(2)).toEqual(['person_localization stop']);
    expect(session.observer.state.value.on).toEqual(['sound_localization']);
  });

  test('restarts in a new session', async () => {
    const on = session.observer.turn_to(true);
    await settled();
    await ending();
    await on;
    world.answers.set('resume', () => 'BAD_PARAMETER');
    world.breaks();
    await world.tries_again();
    await world.opens();
    await settled();
    await ending();
    expect(console.link.session.value).toBe('session-2');
    expect(executed().slice(2)).toEqual(['person_localization start', 'sound_localization start']);
    expect(session.observer.state.value).toMatchObject({ is_wanted: true, on: ['person_localization', 'sound_localization'] });
  });
});

test('the rotation handle of a target is visible, also at the edge of the screen', () => {
  const size = { width: 600, height: 400 };
  expect(knob_distance(15, { x: 300, y: 200 }, -90, size)).toBe(46);
  expect(knob_distance(15, { x: 300, y: 360 }, -90, size)).toBeCloseTo(31); // 9 px from the lower edge
  expect(knob_distance(15, { x: 300, y: 360 }, 90, size)).toBe(46);
  expect(knob_distance(15, { x: 575, y: 200 }, 0, size)).toBe(20); // never at the centre of the target
});
