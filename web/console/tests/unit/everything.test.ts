// Whether everything is stopped, as the console knows it.
import { expect, test } from 'vitest';

import { World } from './world';

const metrics = (stopped: number, not_halted: number) => ({ status: 200, text: `rois_everything_stopped ${stopped}\nrois_components_not_halted ${not_halted}\n` });

async function begun() {
  const world = new World();
  world.pages.set('/metrics', metrics(0, 0));
  world.pages.set('/rois/stop', { status: 202, text: 'stopped\nnot confirmed yet: navigation\nnot confirmed yet: move\n' });
  world.pages.set('/rois/clear', { status: 200, text: 'cleared\n' });
  const console = await world.console();
  console.metrics.poll.watch();
  await world.passes(0);
  return { world, console, everything: console.everything };
}

test('what the gateway answers counts at once, and its metrics from then on', async () => {
  const { world, everything } = await begun();
  expect(everything.view.value).toMatchObject({ stopped: false, waiting: [] });
  await everything.stop();
  expect(everything.view.value).toMatchObject({ stopped: true, waiting: ['navigation', 'move'] });
  await world.passes(1000); // metrics that may have been on their way
  expect(everything.view.value.stopped).toBe(true);
  world.pages.set('/metrics', metrics(1, 1));
  await world.passes(2000);
  expect(everything.view.value).toEqual({ stopped: true, waiting: ['navigation', 'move'] });
  world.pages.set('/metrics', metrics(1, 0));
  await world.passes(1000);
  expect(everything.view.value).toEqual({ stopped: true, waiting: [] });
  await everything.clear();
  expect(everything.view.value.stopped).toBe(false);
});

test('a stop by somebody else is known from the metrics, as soon as an error is told', async () => {
  const { world, everything } = await begun();
  world.pages.set('/metrics', metrics(1, 0));
  await world.passes(2000);
  expect(everything.view.value).toEqual({ stopped: true, waiting: [] });
  world.pages.set('/metrics', metrics(0, 0));
  world.notifies('receive_error', '<error_id>x-1</error_id><error_type>USER_DEFINED_ERROR</error_type>');
  await expect.poll(() => everything.view.value.stopped, { interval: 1 }).toBe(false); // world time stands still
});

test('a stop that did not get through says why, until one does', async () => {
  const { world, everything } = await begun();
  world.pages.set('/rois/stop', { status: 401, text: '' });
  await everything.stop();
  expect(everything.trouble.value).toBe('status 401');
  world.pages.delete('/rois/stop');
  await everything.stop();
  expect(everything.trouble.value).toBe('nobody there');
  expect(everything.view.value.stopped).toBe(false);
  world.pages.set('/rois/stop', { status: 200, text: 'stopped\n' });
  await everything.stop();
  expect(everything.trouble.value).toBe('');
  world.pages.delete('/rois/clear');
  await expect(everything.clear()).rejects.toThrow('nobody there');
  expect(everything.trouble.value).toBe('');
});
