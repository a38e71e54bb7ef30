// The simulated hall in the hands of a test: visitors who do what they are told, in a world that stands still but for the time that is let pass.
import { type Client, command, connect, type CompletedStatus, value } from 'rois-client';

import { root, Stage } from './harness';

const component = 'simulated_hall';

/** Flags of a gateway whose hall is empty and stands still. */
export const still_hall = ['--scenario', `${root}/tests/server/data/empty_hall.xml`, '--sim-speed', '0', '--steering', 'on', '--seed', '7'];

export class Hall {
  private constructor(private readonly client: Client) {}

  static async of(stage: Stage): Promise<Hall> {
    const client = await connect(stage.gateway.url);
    await client.bind(component);
    return new Hall(client);
  }

  /** Of the world; all of it has passed when this resolves. */
  async pass(ms: number): Promise<void> {
    const status = await (await this.client.execute([command(component, 'let_pass', { time: value.int(ms) })])).status();
    if (status !== 'OK') throw new Error(`let_pass: ${status}`);
  }

  /** A visitor comes in and walks there, `x, y, th` or a place, within so many ms of the world. */
  async visit(visitor_ref: string, target_position: string, { known = false, within = 40_000 } = {}): Promise<void> {
    await this.done('enter', { visitor_ref, known: value.bool(known) }, within);
    await this.walk(visitor_ref, target_position, within);
  }

  async walk(visitor_ref: string, target_position: string, within = 40_000): Promise<void> {
    await this.done('walk', { visitor_ref, target_position: value.strings([target_position]) }, within);
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

  // Half a second of the world after the other, until it is done.
  private async done(what: string, named: Parameters<typeof command>[2], within: number): Promise<void> {
    let status: CompletedStatus | undefined;
    const execution = await this.client.execute([command(component, what, named)]);
    void execution.status().then((one) => (status = one));
    for (let passed = 0; status === undefined && passed < within; passed += 500) await this.pass(500);
    if (status !== 'OK') throw new Error(`${what}: ${status ?? `not done within ${within} ms of the world`}`);
  }
}
