// The floor map without a canvas: view, input and scene.
import { describe, expect, test } from 'vitest';

import { at_rest, type Hit, type Input, type Interaction, is_map_key, stepped, type Surroundings } from '../../src/map/interaction';
import { Glide } from '../../src/map/painting/glide';
import { Labels } from '../../src/map/painting/labels';
import { label_of } from '../../src/map/painting/picture';
import { age } from '../../src/map/formats';
import { scene_of, type SceneInput } from '../../src/map/scene';
import { box_around, fitted, panned, pinched, round_step, to_floor, to_screen, with_point, zoomed } from '../../src/map/view';
import { Ring } from '../../src/state/base/ring';
import { bearing, obstacle_at, on_map, turned } from '../../src/state/floor/floor';
import type { FloorMap } from '../../src/state/floor/floor_map';
import type { Entity, Robot } from '../../src/state/floor/things';

const size = { width: 800, height: 600 };
const view = { x: 5000, y: 3000, scale: 0.1 };
const map: FloorMap = {
  name: 'Hall',
  crs: 'urn:hall',
  bounds: { x: 0, y: 0, width: 10_000, depth: 6000 },
  walls: [{ x1: 5000, y1: 0, x2: 5000, y2: 2000 }],
  furniture: [{ x: 8000, y: 4000, width: 1000, depth: 500 }],
  places: [{ name: 'desk', x: 2000, y: 1000, heading: 90, width: 2000, depth: 2000 }],
  robots: [
    { name: 'robot1', radius: 280 },
    { name: 'robot2', radius: 300, frame: { crs: 'urn:own', x: 1000, y: 2000, heading: 90 } },
  ],
};

describe('the view', () => {
  test('converts from floor to screen and back: y points up', () => {
    expect(to_screen(view, size, { x: 5000, y: 3000 })).toEqual({ x: 400, y: 300 });
    expect(to_screen(view, size, { x: 6000, y: 4000 })).toEqual({ x: 500, y: 200 });
    expect(to_floor(view, size, { x: 500, y: 200 })).toEqual({ x: 6000, y: 4000 });
  });

  test('is panned with the point under the pointer', () => {
    const to = panned(view, 30, -20);
    expect(to_screen(to, size, { x: 5000, y: 3000 })).toEqual({ x: 430, y: 280 });
  });

  test('is zoomed around a point, within limits', () => {
    const at = { x: 100, y: 500 };
    const to = zoomed(view, size, at, 2);
    expect(to.scale).toBe(0.2);
    const [before, after] = [to_floor(view, size, at), to_floor(to, size, at)];
    expect(after.x).toBeCloseTo(before.x);
    expect(after.y).toBeCloseTo(before.y);
    expect(zoomed(view, size, at, 1e9).scale).toBe(0.5);
    expect(zoomed(view, size, at, 1e-9).scale).toBe(0.001);
  });

  test('is pinched: both points stay under their fingers', () => {
    const [before, after] = [[{ x: 300, y: 300 }, { x: 500, y: 300 }], [{ x: 250, y: 200 }, { x: 650, y: 200 }]] as const;
    const to = pinched(view, size, before, after);
    expect(to.scale).toBeCloseTo(0.2);
    for (const i of [0, 1] as const) {
      const at = to_screen(to, size, to_floor(view, size, before[i]));
      expect(at.x).toBeCloseTo(after[i].x);
      expect(at.y).toBeCloseTo(after[i].y);
    }
  });

  test('shows a whole box with a margin', () => {
    const whole = fitted(map.bounds, size, 50);
    expect(whole).toEqual({ x: 5000, y: 3000, scale: 0.07 });
    expect(to_screen(whole, size, { x: 0, y: 3000 }).x).toBeCloseTo(50);
    expect(fitted({ x: 0, y: 0, width: 0, depth: 0 }, { width: 0, height: 0 }, 50).scale).toBeLessThanOrEqual(0.5);
  });

  test('moves only as far as needed to show a point', () => {
    expect(with_point(view, size, { x: 5000, y: 3000 }, 50)).toEqual(view);
    const to = with_point(view, size, { x: 10_000, y: 3000 }, 50);
    expect(to_screen(to, size, { x: 10_000, y: 3000 }).x).toBeCloseTo(750);
  });

  test('has round grid steps, and a box in multiples of 5 m around all points', () => {
    expect([1, 1.5, 3, 70, 200, 501].map(round_step)).toEqual([1, 2, 5, 100, 200, 1000]);
    expect(box_around([])).toEqual({ x: -5000, y: -5000, width: 10_000, depth: 10_000 });
    expect(box_around([{ x: 7000, y: -9000 }])).toEqual({ x: -5000, y: -10_000, width: 15_000, depth: 15_000 });
  });
});

describe('the floor', () => {
  test('computes directions', () => {
    expect([190, -190, 180, -180, 720].map(turned)).toEqual([-170, 170, 180, 180, 0]);
    expect(bearing({ x: 0, y: 0 }, { x: 0, y: 5 })).toBe(90);
  });

  test("converts from a robot's frame to the map; frames without a position are unknown", () => {
    const pose = on_map(map, 'URN:OWN', { x: 500, y: 0, th: 120 })!;
    expect([pose.x, pose.y].map(Math.round)).toEqual([1000, 2500]);
    expect(pose.th).toBe(-150);
    expect(on_map(map, 'urn:hall', { x: 1, y: 2 })).toEqual({ x: 1, y: 2 });
    expect(on_map(map, 'urn:elsewhere', { x: 1, y: 2 })).toBeUndefined();
    expect(on_map(undefined, 'urn:elsewhere', { x: 1, y: 2 })).toEqual({ x: 1, y: 2 });
  });

  test.each([
    [3000, 3000, undefined],
    [100, 3000, 'outside'],
    [8500, 4200, 'furniture'],
    [7800, 4200, 'furniture'],
    [5200, 1000, 'wall'],
    [5000, 2300, undefined],
  ])('at %i, %i a robot of 250 mm has this obstacle: %s', (x, y, what) => expect(obstacle_at(map, { x, y }, 250)).toBe(what));
});

describe('input', () => {
  const things = [{ key: 'robot robot1', x: 1000, y: 1000 }, { key: 'person person-1', x: 9000, y: 3000 }];
  let hit: Hit = { what: 'floor' };
  const around: Surroundings = { size, whole: view, hit: () => hit, arrival: () => 90, things };
  const after = (inputs: Input[], before: Interaction = at_rest) => inputs.reduce((state, input) => stepped(state, input, around), before);
  const press = (x: number, y: number, more = {}): Input => ({ kind: 'press', pointer: 1, at: { x, y }, aims: false, ...more });
  const move = (x: number, y: number, pointer = 1): Input => ({ kind: 'move', pointer, at: { x, y } });
  const release = (pointer = 1): Input => ({ kind: 'release', pointer, at: { x: 0, y: 0 } });
  const key = (name: string, more = {}): Input => ({ kind: 'key', key: name, shift: false, ctrl: false, ...more });

  test('a click on the floor sets a target; a small movement is still a click', () => {
    hit = { what: 'floor' };
    expect(after([press(500, 200), move(502, 201), release()])).toMatchObject({ target: { x: 6000, y: 4000 }, view: undefined, gesture: { kind: 'none' } });
  });

  test('a click on a place selects it by name, with its direction', () => {
    hit = { what: 'place', name: 'desk', x: 2000, y: 1000, th: 90 };
    expect(after([press(10, 10), release()]).target).toEqual({ x: 2000, y: 1000, th: 90, place: 'desk' });
  });

  test('a click on a thing selects it and drops the target', () => {
    hit = { what: 'thing', key: 'person person-1' };
    expect(after([press(10, 10), release()], { ...at_rest, target: { x: 1, y: 1 } })).toMatchObject({ chosen: 'person person-1', target: undefined });
  });

  test('dragging the floor pans and sets no target', () => {
    hit = { what: 'floor' };
    const state = after([press(400, 300), move(450, 280), move(460, 280), release()]);
    expect(state.target).toBeUndefined();
    expect(to_screen(state.view!, size, { x: 5000, y: 3000 })).toEqual({ x: 460, y: 280 });
  });

  test('dragging from the target sets its direction; a turned place becomes a point', () => {
    hit = { what: 'target' };
    const state = after([press(500, 200), move(500, 150), release()], { ...at_rest, target: { x: 6000, y: 4000, th: 0, place: 'desk' } });
    expect(state.target).toEqual({ x: 6000, y: 4000, th: 90 });
    expect(state.view).toBeUndefined();
  });

  test('Shift and drag sets place and direction at once', () => {
    const state = after([press(500, 200, { aims: true }), move(505, 200), move(400, 200), release()]);
    expect(state.target).toEqual({ x: 6000, y: 4000, th: 180 });
  });

  test('two fingers zoom; after one is lifted the other pans', () => {
    hit = { what: 'floor' };
    const state = after([press(300, 300), press(500, 300, { pointer: 2 }), move(700, 300, 2), release(1)]);
    expect(state.view!.scale).toBeCloseTo(0.2);
    expect(state.gesture).toMatchObject({ kind: 'panning', pointer: 2 });
    const end = after([move(710, 300, 2), release(2)], state);
    expect(end.gesture.kind).toBe('none');
    expect(end.target).toBeUndefined();
  });

  test('other pointers and unknown releases change nothing', () => {
    expect(after([move(1, 1, 7), release(7), { kind: 'cancel', pointer: 7 }])).toBe(at_rest);
    expect(after([press(1, 1), { kind: 'cancel', pointer: 1 }]).gesture.kind).toBe('none');
  });

  test('arrows move a cursor in round steps, and the view follows', () => {
    const state = after([key('ArrowRight'), key('ArrowUp', { shift: true })]);
    expect(state.cursor).toEqual({ x: 5000, y: 4000 });
    expect(state.view).toBeUndefined();
    const far = after(Array.from({ length: 5 }, () => key('ArrowLeft', { shift: true })), state);
    expect(to_screen(far.view!, size, far.cursor!).x).toBeCloseTo(48);
  });

  test('Enter sets the target at the cursor, Q and E turn it, Escape drops one thing at a time', () => {
    hit = { what: 'floor' };
    const set = after([key('ArrowRight'), key('Enter'), key('q')]);
    expect(set).toMatchObject({ cursor: { x: 5250, y: 3000 }, target: { x: 5250, y: 3000, th: 105 } });
    expect(after([key('e'), key('e')], set).target!.th).toBe(75);
    const dropped = after([key('Escape')], set);
    expect(dropped).toMatchObject({ target: undefined, cursor: { x: 5250, y: 3000 } });
    expect(after([key('Escape')], dropped).cursor).toBeUndefined();
  });

  test('N and P step through all things', () => {
    const first = after([key('n')]);
    expect(first).toMatchObject({ chosen: 'robot robot1', cursor: { x: 1000, y: 1000 } });
    expect(after([key('n')], first).chosen).toBe('person person-1');
    expect(after([key('p')], first).chosen).toBe('person person-1');
    expect(after([key('n'), key('n')], first).chosen).toBe('robot robot1');
  });

  test("keys zoom, fit and pan; other keys are the page's", () => {
    expect(after([key('+')]).view!.scale).toBeCloseTo(0.125);
    expect(after([key('+'), key('0')]).view).toBeUndefined();
    expect(after([key('ArrowLeft', { ctrl: true })]).view).toEqual({ ...view, x: 4200 });
    const event = (name: string, more = {}) => ({ key: name, ctrlKey: false, metaKey: false, altKey: false, ...more });
    expect(['ArrowUp', 'Enter', 'q', '+', 'Escape'].every((name) => is_map_key(event(name)))).toBe(true);
    expect([event('Tab'), event('a'), event('q', { ctrlKey: true }), event('ArrowLeft', { altKey: true })].some(is_map_key)).toBe(false);
  });
});

describe('the scene', () => {
  const now = 100_000;
  const thing = { codebook: '', component: 'localization', crs: 'urn:hall', x: 1000, y: 2000, z: 0, at: now - 100 };
  const person = (ref: string, more: Partial<Entity> = {}): Entity => ({ ...thing, ref, kind: 'person', is_seen: true, trail: new Ring(9), ...more });
  const robot = (ref: string, more: Partial<Robot> = {}): Robot => ({ ...thing, ref, trail: new Ring(9), ...more });
  const input = (more: Partial<SceneInput>): SceneInput => ({ robots: [], entities: [], map, now, is_live: true, senses: () => true, acts_for: () => [], ...more });
  const states = (more: Partial<SceneInput>) => scene_of(input(more)).shown.map((one) => one.freshness);

  test("robots have the map's size, people their identified name", () => {
    const { shown } = scene_of(input({ robots: [robot('robot1', { th: 30 })], entities: [person('person-1', { identity: { ref: 'tanaka', codebook: 'v', at: 0 } })] }));
    expect(shown).toMatchObject([{ key: 'person person-1', name: 'tanaka' }, { key: 'robot robot1', name: 'robot1', radius: 280, th: 30 }]);
  });

  test("a thing in a robot's own frame is drawn at its place on the map, with a turned ellipse", () => {
    const { shown, lost } = scene_of(input({ entities: [person('a', { crs: 'urn:own', th: 0, covariance: [400, 0, 0, 100] }), person('b', { crs: 'urn:nowhere' })] }));
    expect(shown).toHaveLength(1);
    expect(shown[0]).toMatchObject({ th: 90, ellipse: { a: 20, b: 10, angle: 90 } });
    expect(lost.map((one) => one.ref)).toEqual(['b']);
  });

  test('people are quiet when they stand, gone when out of sight, unknown without sensing or link', () => {
    expect(states({ entities: [person('a')] })).toEqual(['live']);
    expect(states({ entities: [person('a', { at: now - 9000 })] })).toEqual(['quiet']);
    expect(states({ entities: [person('a', { at: now - 31_000 })] })).toEqual(['old']); // whatever the bindings
    expect(states({ entities: [person('a', { is_seen: false })] })).toEqual(['gone']);
    expect(states({ entities: [person('a', { at: now - 9000 })], senses: () => false })).toEqual(['unknown']);
    expect(states({ entities: [person('a', { at: now - 31_000 })], senses: () => false })).toEqual([]);
    expect(states({ entities: [person('a', { is_seen: false })], is_live: false })).toEqual(['gone']);
    expect(states({ entities: [person('s', { kind: 'sound', at: now - 60_000 })], is_live: false })).toEqual(['unknown']);
    expect(states({ entities: [person('a')], senses: () => false })).toEqual(['live']); // reported just now, whatever the bindings
    expect(states({ entities: [person('a')], is_live: false })).toEqual(['unknown']);
    expect(states({ entities: [person('a', { at: now - 9000, unknown_since: now - 50 })] })).toEqual(['unknown']);
  });

  test('the label of a standing person shows the age of the last report', () => {
    const label = (ms: number) => label_of(scene_of(input({ entities: [person('anna', { at: now - ms })] })).shown[0]!, age);
    expect([100, 6000, 7000, 12_000, 14_000, 16_000, 61_000].map(label)).toEqual(['anna', 'anna · 6 s', 'anna · 7 s', 'anna · 10 s', 'anna · 10 s', 'anna · 15 s', 'anna · 1 min']);
  });

  test('a person is hidden half a minute after leaving, except while the link is lost', () => {
    const old = person('a', { is_seen: false, at: now - 31_000 });
    expect(states({ entities: [old] })).toEqual([]);
    expect(states({ entities: [old], is_live: false })).toEqual(['gone']);
  });

  test('a sound that is no longer reported fades, because its end is not reported', () => {
    const sound = (age: number) => person('s', { kind: 'sound', at: now - age, th: 20 });
    expect(states({ entities: [sound(500)] })).toEqual(['live']);
    expect(states({ entities: [sound(3000)] })).toEqual(['gone']);
    expect(states({ entities: [sound(7000)] })).toEqual([]);
    expect(scene_of(input({ entities: [sound(500)] })).shown[0]!.th).toBeUndefined();
  });

  test('a face stays while a person is there, because looking away is not reported', () => {
    const face = (age: number, x = 1000) => person('f', { kind: 'face', at: now - age, x });
    const body = person('a', { at: now - 9000 });
    expect(states({ entities: [body, face(9000)] })).toEqual(['quiet', 'quiet']);
    expect(states({ entities: [body, face(4000, 3000)] })).toEqual(['quiet', 'gone']);
    expect(states({ entities: [body, face(9000, 3000)] })).toEqual(['quiet']);
    expect(states({ entities: [face(500)] })).toEqual(['live']);
  });

  test('a robot without reports is old', () => {
    expect(states({ robots: [robot('robot1', { at: now - 3000 })] })).toEqual(['gone']);
  });
});

describe('gliding', () => {
  test('noise of a resting thing is not drawn; a movement is', () => {
    const glide = new Glide();
    const slack = 30; // mm
    glide.pose('a', { x: 0, y: 0, th: 0 }, 0, slack);
    const noisy = { x: 20, y: -10, th: 2 };
    expect(glide.is_news('a', noisy, 1500, slack)).toBe(false);
    expect(glide.pose('a', noisy, 1500, slack)).toEqual({ x: 0, y: 0, th: 0 });
    expect(glide.is_news('a', { x: 0, y: 0, th: 10 }, 1600, slack)).toBe(true);
    expect(glide.is_news('a', { x: 31, y: 0, th: 0 }, 1600, slack)).toBe(true);
    expect(glide.is_news('b', { x: 0, y: 0 }, 1600, slack)).toBe(true);
    glide.pose('a', { x: 40, y: 0, th: 0 }, 1700, slack);
    expect(glide.pose('a', { x: 40, y: 0, th: 0 }, 2100, slack)).toEqual({ x: 40, y: 0, th: 0 });
    expect(glide.is_news('a', { x: 45, y: 0, th: 0 }, 2200, slack)).toBe(true); // it moves: every step counts
    expect(glide.is_news('a', { x: 45, y: 0, th: 0 }, 2800, slack)).toBe(false);
  });

  test('moves smoothly from pose to pose in the time between the reports', () => {
    const glide = new Glide();
    expect(glide.pose('a', { x: 0, y: 0, th: 350 }, 1000)).toEqual({ x: 0, y: 0, th: 350 });
    expect(glide.is_moving(1000)).toBe(false);
    glide.pose('a', { x: 100, y: 0, th: 10 }, 1200);
    expect(glide.pose('a', { x: 100, y: 0, th: 10 }, 1300)).toEqual({ x: 50, y: 0, th: 360 });
    expect(glide.is_moving(1300)).toBe(true);
    expect(glide.pose('a', { x: 100, y: 0, th: 10 }, 1400)).toEqual({ x: 100, y: 0, th: 10 });
    expect(glide.is_moving(1400)).toBe(false);
  });

  test('jumps with reduced motion and over long distances', () => {
    const glide = new Glide();
    glide.pose('a', { x: 0, y: 0 }, 0);
    expect(glide.pose('a', { x: 5000, y: 0 }, 100).x).toBe(5000);
    glide.is_still = true;
    expect(glide.pose('a', { x: 5100, y: 0 }, 200).x).toBe(5100);
    expect(glide.is_moving(200)).toBe(false);
  });
});

describe('names', () => {
  const label = (key: string, x: number, y: number, must = false) => ({ key, width: 60, at: { x, y }, radius: 10, must });

  test('do not overlap, or are omitted', () => {
    const labels = new Labels();
    const places = labels.placed([label('a', 100, 100), label('b', 102, 100), label('c', 101, 101), label('d', 101, 99), label('e', 100, 100)], size);
    expect([...places.keys()]).toEqual(['a', 'b', 'c', 'd']);
    expect(new Set([...places.values()].map(({ x, y }) => `${Math.sign(x - 70)} ${Math.sign(y - 91)}`)).size).toBe(4);
  });

  test('stay on their side and inside the screen', () => {
    const labels = new Labels();
    const at_edge = labels.placed([label('a', 795, 100)], size).get('a')!;
    expect(at_edge.x).toBeLessThan(795);
    expect(labels.placed([label('a', 700, 100)], size).get('a')!.x).toBeLessThan(700);
  });

  test('are shown if they must be, and other boxes are avoided', () => {
    const labels = new Labels();
    const everywhere = { x: 0, y: 0, ...size };
    expect([...labels.placed([label('a', 100, 100), label('b', 300, 300, true)], size, [everywhere]).keys()]).toEqual(['b']);
  });
});
