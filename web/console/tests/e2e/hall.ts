// The simulated hall controlled by a test: visitors take orders, and time passes only on request.
import type { Locator, Page } from 'playwright-core';
import { type Arguments, type Client, command, connect, type CompletedStatus, value } from 'rois-client';
import { afterAll, beforeAll } from 'vitest';

import type { Console } from '../../src/state/console';
import { root, Stage } from './harness';

const component = 'simulated_hall';

/** Pictures for docs/ are taken (docs/console.md): time then runs at real speed, so that the time line shows real durations. */
export const takes_pictures = process.env['ROIS_PICTURES'] === 'docs';

/** Flags of a gateway with an empty hall and stopped time. */
export const still_hall = ['--scenario', `${root}/tests/server/data/empty_hall.xml`, '--sim-speed', '0', '--seed', '7'];
/** The robots of Annex C in addition to the usual one. */
export const more_profiles = ['--profiles', `${root}/components/simulation/profiles`];

/**
 * Gives the tests of a file a stage whose hall is empty and stands still: set before the first test, struck after the last. `begin` runs after it is
 * set.
 */
export function set_still_hall(begin: (stage: Stage, hall: Hall) => Promise<void>, ...flags: string[]): void {
  let stage: Stage;
  let hall: Hall;
  beforeAll(async () => {
    stage = await Stage.set(...still_hall, ...flags);
    hall = await Hall.of(stage);
    await begin(stage, hall);
  });
  afterAll(async () => {
    await hall.close();
    await stage.strike();
  });
}

export class Hall {
  private constructor(private readonly client: Client) {}

  static async of(stage: Stage): Promise<Hall> {
    const client = await connect(stage.gateway.url);
    await client.bind(component);
    return new Hall(client);
  }

  /** In ms of simulated time, which have passed when this resolves. */
  async pass(ms: number): Promise<void> {
    const status = await (await this.client.execute([command(component, 'let_pass', { time: value.int(ms) })])).status();
    if (status !== 'OK') throw new Error(`let_pass: ${status}`);
    if (takes_pictures) await new Promise((passed) => setTimeout(passed, ms));
  }

  /** Lets time pass in steps until the page shows something. */
  async pass_until(page: Page, shown: Locator, step = 500, most = 240 * step): Promise<void> {
    for (let passed = 0; passed < most; passed += step) {
      if ((await shown.count()) > 0) return;
      await this.pass(step);
      await page.evaluate(all_drawn);
    }
    await shown.first().waitFor({ state: 'attached', timeout: 1 });
  }

  /** Lets time pass in steps until a promise is settled. */
  async pass_while<T>(pending: Promise<T>, step = 500): Promise<T> {
    let is_pending = true;
    const over = () => (is_pending = false);
    pending.then(over, over);
    while (is_pending) await this.pass(step);
    return pending;
  }

  /** Runs a command in the page's console and lets time pass until it has ended. Returns its status. */
  run(page: Page, ref: string, command_type: string, named: Arguments = {}): Promise<string> {
    return this.pass_while(page.evaluate(run_there, [ref, command_type, named] as const));
  }

  /** A visitor comes in and walks to `x, y, th` or a place, within this simulated time. */
  async visit(visitor_ref: string, target_position: string, { known = false, within = 40_000 } = {}): Promise<void> {
    await this.enter(visitor_ref, { known, within });
    await this.walk(visitor_ref, target_position, within);
  }

  async enter(visitor_ref: string, { known = false, within = 40_000 } = {}): Promise<void> {
    await this.done('enter', { visitor_ref, known: value.bool(known) }, within);
  }

  async walk(visitor_ref: string, target_position: string, within = 40_000): Promise<void> {
    await this.done('walk', { visitor_ref, target_position: value.strings([target_position]) }, within);
  }

  /** Starts walking; continues while time passes. */
  async sets_out(visitor_ref: string, target_position: string): Promise<void> {
    await this.client.execute([command(component, 'walk', { visitor_ref, target_position: value.strings([target_position]) })]);
  }

  async say(visitor_ref: string, text: string): Promise<void> {
    await this.client.execute([command(component, 'say', { visitor_ref, text })]);
  }

  async leave(visitor_ref: string, within = 40_000): Promise<void> {
    await this.done('leave', { visitor_ref }, within);
  }

  close(): Promise<void> {
    return this.client.close();
  }

  // Lets time pass in steps of 0.5 s until the command has completed.
  private async done(what: string, named: Parameters<typeof command>[2], within: number): Promise<void> {
    let status: CompletedStatus | undefined;
    const execution = await this.client.execute([command(component, what, named)]);
    void execution.status().then((one) => (status = one));
    for (let passed = 0; status === undefined && passed < within; passed += 500) await this.pass(500);
    if (status !== 'OK') throw new Error(`${what}: ${status ?? `not done within ${within} ms of the world`}`);
  }
}

// Runs in the page: notifications arrive in order, so after an answer all earlier ones have arrived and been drawn.
async function all_drawn(): Promise<void> {
  const { rois } = window as unknown as { rois: Console };
  await rois.documents.as_own(() => rois.search());
  await new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)));
}

async function run_there([ref, command_type, named]: readonly [string, string, Arguments]): Promise<string> {
  const { rois } = window as unknown as { rois: Console };
  const [status = 'unknown'] = await (await rois.run(ref, command_type, named)).ends;
  return status;
}
