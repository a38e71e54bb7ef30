// Whether everything is stopped, as the console knows it.
import { namespaces } from 'rois-client';
import { expect, test } from 'vitest';

import { World } from './world';

const state = (stopped: boolean, ...not_halted: string[]) => ({
  status: 200,
  text: `<stop_state xmlns="${namespaces.message}"><stopped>${stopped}</stopped>${not_halted.map((ref) => `<not_halted>${ref}</not_halted>`).join('')}</stop_state>`,
});
const stopped_line = 'stopped: nothing starts until POST /rois/clear\n';
const moving = (...refs: string[]) => ({ status: 503, text: stopped_line + refs.map((ref) => `${ref} has not confirmed that it stands still\n`).join('') });
const metrics = (stopped: number, not_halted: number) => ({ status: 200, text: `rois_everything_stopped ${stopped}\nrois_components_not_halted ${not_halted}\n` });

async function begun() {
  const world = new World();
  world.pages.set('/metrics', metrics(0, 0));
  world.pages.set('/rois/stop', state(true, 'navigation', 'move'));
  world.pages.set('/rois/clear', state(false));
  world.pages.set('/readyz', moving('navigation', 'move'));
  const console = await world.console();
  console.metrics.poll.watch();
  await world.passes(0);
  return { world, console, everything: console.everything };
}

test('the answer of the gateway counts at once, and its metrics from then on', async () => {
  const { world, everything } = await begun();
  expect(everything.view.value).toEqual({ stopped: false, waiting: [] });
  world.pages.set('/rois/stop', state(true));
  await everything.stop();
  expect(everything.view.value).toEqual({ stopped: true, waiting: [] });
  await world.passes(1000); // metrics that may have been on their way
  expect(everything.view.value.stopped).toBe(true);
  await world.passes(2000);
  expect(everything.view.value.stopped).toBe(false);
  await everything.stop();
  await everything.clear();
  expect(everything.view.value.stopped).toBe(false);
});

test('unconfirmed components are named until they confirm', async () => {
  const { world, everything } = await begun();
  world.pages.set('/metrics', metrics(1, 2));
  await everything.stop();
  expect(everything.view.value).toEqual({ stopped: true, waiting: ['navigation', 'move'] });
  world.pages.set('/readyz', moving('move'));
  await world.passes(1000);
  expect(everything.view.value).toEqual({ stopped: true, waiting: ['move'] });
  world.pages.set('/readyz', { status: 503, text: 'the engine has not ticked for more than 0.5 s: a component blocks, or the process is overloaded\n' });
  await world.passes(3000);
  expect(everything.view.value).toEqual({ stopped: true, waiting: ['move'] });
  world.pages.delete('/readyz');
  await world.passes(3000);
  expect(everything.view.value).toEqual({ stopped: true, waiting: ['move'] });
  world.pages.set('/readyz', moving());
  world.pages.set('/metrics', metrics(1, 0));
  await world.passes(1000);
  expect(everything.view.value).toEqual({ stopped: true, waiting: [] });
});

test('unconfirmed components are requested without metrics while the link is lost', async () => {
  const { world, everything } = await begun();
  await everything.stop();
  world.breaks();
  world.pages.delete('/metrics');
  world.pages.set('/readyz', moving());
  await world.passes(1000);
  expect(everything.view.value).toEqual({ stopped: true, waiting: [] });
});

test('an answer that was under way does not count after a clear', async () => {
  const { world, everything } = await begun();
  await everything.stop();
  const answers: ((page: Response) => void)[] = [];
  const { fetch } = world;
  world.fetch = (path) => (path === '/readyz' ? new Promise((answer) => answers.push(answer)) : fetch.call(world, path));
  await world.passes(250);
  await everything.clear();
  for (const answer of answers) answer(new Response(moving('move').text, { status: 503 }));
  await world.passes(0);
  expect(everything.view.value.stopped).toBe(false);
});

test('a stop by another application is known from the metrics as soon as an error is reported', async () => {
  const { world, everything } = await begun();
  world.pages.set('/metrics', metrics(1, 0));
  await world.passes(2000);
  expect(everything.view.value).toEqual({ stopped: true, waiting: [] });
  world.pages.set('/metrics', metrics(0, 0));
  world.notifies('receive_error', '<error_id>x-1</error_id><error_type>USER_DEFINED_ERROR</error_type>');
  await expect.poll(() => everything.view.value.stopped, { interval: 1 }).toBe(false); // world time stands still
});

test('unconfirmed components are named also after a stop by another application', async () => {
  const { world, everything } = await begun();
  world.pages.set('/metrics', metrics(1, 2));
  await world.passes(2000);
  expect(everything.view.value).toEqual({ stopped: true, waiting: ['navigation', 'move'] });
  world.pages.set('/readyz', { status: 200, text: 'ready\n' }); // cleared meanwhile
  world.pages.set('/metrics', metrics(0, 0));
  await world.passes(1000);
  expect(everything.view.value).toEqual({ stopped: false, waiting: [] });
});

test('a stop that failed shows the reason until a stop succeeds', async () => {
  const { world, everything } = await begun();
  world.pages.set('/rois/stop', { status: 401, text: '' });
  await everything.stop();
  expect(everything.trouble.value).toBe('status 401');
  world.pages.delete('/rois/stop');
  await everything.stop();
  expect(everything.trouble.value).toBe('nobody there');
  expect(everything.view.value.stopped).toBe(false);
  world.pages.set('/rois/stop', state(true));
  await everything.stop();
  expect(everything.trouble.value).toBe('');
  world.pages.delete('/rois/clear');
  await expect(everything.clear()).rejects.toThrow('nobody there');
  expect(everything.trouble.value).toBe('');
});
