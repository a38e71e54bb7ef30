// Positions of the robots: polls `robot_position` while watched, less often while no robot moves.
import { type Client, component_ref } from 'rois-client';

import type { Documents } from '../session/documents';
import type { Environment } from '../base/environment';
import { Poll } from '../base/poll';
import type { ComponentView } from '../engine/profile_state';
import { Pulse } from '../base/pulse';
import { located_in, placed, type Robot } from './things';

const forgotten_after = 60_000; // ms
const rests_after = 3000; // ms without movement
const period = 100; // ms
const period_at_rest = 500; // ms

export class RobotsState {
  /** By ref. Robots change in place: read `pulse.beat.value` first. */
  readonly all = new Map<string, Robot>();
  readonly pulse: Pulse;
  readonly poll: Poll;
  private asked_at = 0;

  constructor(
    private readonly environment: Environment,
    private readonly documents: Documents,
    private readonly client: () => Client | undefined,
    private readonly components: () => readonly ComponentView[],
    /** Whether this session runs a command that may move a robot. */
    private readonly is_at_work: () => boolean,
    may_ask: () => boolean,
  ) {
    this.pulse = new Pulse(environment);
    this.poll = new Poll(environment, period, () => this.ask(), () => may_ask() && this.is_due());
  }

  /** A new session: positions in between are unknown. */
  forget(): void {
    this.all.clear();
    this.pulse.touch();
  }

  private is_due(): boolean {
    const now = this.environment.now();
    const is_moving = [...this.all.values()].some(({ trail }) => now - trail.at(-1)!.at < rests_after);
    return is_moving || this.is_at_work() || now - this.asked_at >= period_at_rest;
  }

  private async ask(): Promise<void> {
    this.asked_at = this.environment.now();
    const client = this.client();
    if (!client) return;
    const askable = this.components().filter((one) => one.queries.some((query) => query.name === 'robot_position'));
    await Promise.all(
      askable.map(async ({ ref }) => {
        const { results } = await this.documents.as_own(() => client.query('robot_position', component_ref(ref)));
        const at = this.environment.now();
        const codebook = results.get('robot_ref')?.data_type_ref.codebook_ref ?? '';
        for (const located of located_in(results, 'robot_ref'))
          this.all.set(located.ref, placed(this.all.get(located.ref), located, { codebook, component: ref, at }, (thing) => thing));
      }),
    );
    const now = this.environment.now();
    for (const [ref, robot] of this.all) if (now - robot.at > forgotten_after) this.all.delete(ref);
    this.pulse.touch();
  }
}
