// Positions of the robots: polls `robot_position` while watched, less often while no robot moves.
import type { Environment } from '../base/environment';
import type { Poll } from '../base/poll';
import { Pulse } from '../base/pulse';
import type { ProfileState } from '../engine/profile_state';
import type { OwnRequests } from '../session/own_requests';
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
    private readonly requests: OwnRequests,
    private readonly profile: ProfileState,
    /** Whether this session runs a command that may move a robot. */
    private readonly is_at_work: () => boolean,
  ) {
    this.pulse = new Pulse(environment);
    this.poll = requests.poll(period, () => this.ask(), () => this.is_due());
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
    await Promise.all(
      this.profile.with_query('robot_position').map(async ({ ref }) => {
        const results = await this.requests.query('robot_position', ref);
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
