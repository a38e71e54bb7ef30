// Simulated persons, moved by commands to the simulator's Hall component. Engines without it have real persons.
import { computed } from '@preact/signals';
import { type Arguments, type Pose, pose_of, pose_text, RoisError, value } from 'rois-client';

import type { Environment } from '../base/environment';
import type { Poll } from '../base/poll';
import { Pulse } from '../base/pulse';
import type { ProfileState } from '../engine/profile_state';
import type { CommandEntry, CommandsState } from '../session/commands_state';
import type { OwnRequests } from '../session/own_requests';

/** A simulated person: the true position, not a robot's measurement. Map frame, mm, degrees counter-clockwise. */
export interface Visitor {
  ref: string;
  x: number;
  y: number;
  th: number;
  /** Whether identification knows the person. */
  known: boolean;
  /** Whether the person takes commands. Others follow the engine's scenario. */
  steered: boolean;
}

/** How a command ended; `reason` may be given for a failure. */
export interface Outcome {
  status: string;
  reason: string;
}

/** Gestures of visitors. */
export const gestures = ['wave', 'nod', 'shake_head', 'bow', 'point', 'raise_hand', 'clap', 'thumbs_up'] as const;
export type Gesture = (typeof gestures)[number];

export interface HallParts {
  requests: OwnRequests;
  commands: CommandsState;
  profile: ProfileState;
  /** Binds, executes, and releases at the end. */
  run: (ref: string, command_type: string, named: Arguments) => Promise<{ command_ids: string[]; ends: Promise<string[]> }>;
}

const period = 150; // ms
const period_at_rest = 1000; // ms
const rests_after = 3000; // ms without movement

export class HallState {
  /** The Hall component; undefined if the engine has none. */
  readonly component = computed(() => this.parts.profile.of_type('Hall')[0]);
  /** Whether simulated time runs only by `let_pass`, as the engine's profile states. */
  readonly stands_still = computed(() => {
    const speed = this.parts.profile.profile.value?.engine.parameters.find(({ name }) => name === 'sim_speed')?.default_value;
    return speed !== undefined && Number(speed) === 0;
  });
  /** By ref, in order of arrival. Entries change in place: read `pulse.beat.value` first. */
  readonly visitors = new Map<string, Visitor>();
  readonly pulse: Pulse;
  readonly poll: Poll;
  /** Time of the last answer in ms since 1970; 0: none yet. */
  reported_at = 0;
  private moved_at = 0;

  constructor(
    private readonly environment: Environment,
    private readonly parts: HallParts,
  ) {
    this.pulse = new Pulse(environment);
    this.poll = parts.requests.poll(period, () => this.look(), () => this.component.value !== undefined && this.is_due());
  }

  // --- Commands to visitors. They resolve at the end of the command and reject with RoisError if it is refused. ---

  enter(ref: string, { language, known }: { language?: string; known?: boolean } = {}): Promise<Outcome> {
    return this.command('enter', { visitor_ref: ref, language: language || undefined, known });
  }
  /** Walks to a place or position at once, dropping the present walk. */
  walk(ref: string, to: string | Omit<Pose, 'th'> | Pose): Promise<Outcome> {
    return this.command('walk', { visitor_ref: ref, target_position: value.strings([target_text(to)]) });
  }
  say(ref: string, text: string, language?: string): Promise<Outcome> {
    return this.command('say', { visitor_ref: ref, text, language: language || undefined });
  }
  gesture(ref: string, gesture: Gesture): Promise<Outcome> {
    return this.command('gesture', { visitor_ref: ref, gesture });
  }
  leave(ref: string): Promise<Outcome> {
    return this.command('leave', { visitor_ref: ref });
  }

  /** Lets simulated time pass while it is stopped; rounded to a multiple of 20 ms. */
  async let_pass(ms: number): Promise<Outcome> {
    const outcome = await this.command('let_pass', { time: Math.max(20, Math.round(ms / 20) * 20) });
    this.moved_at = this.environment.now();
    this.poll.now();
    return outcome;
  }

  /** The visitor's open commands, oldest first. */
  orders_of(ref: string): CommandEntry[] {
    const hall = this.component.value?.ref;
    return this.parts.commands
      .open()
      .filter((one) => one.component === hall && one.arguments.some(({ name, values }) => name === 'visitor_ref' && values[0] === ref));
  }

  /** The visitors who wait for the entrance to be free. */
  awaited(): string[] {
    const hall = this.component.value?.ref;
    const enters = this.parts.commands.open().filter((one) => one.component === hall && one.command_type === 'enter');
    return enters
      .flatMap((one) => one.arguments.find(({ name }) => name === 'visitor_ref')?.values ?? [])
      .filter((ref) => !this.visitors.has(ref));
  }

  is_taken(ref: string): boolean {
    return this.visitors.has(ref) || this.awaited().includes(ref);
  }

  forget(): void {
    this.visitors.clear();
    this.reported_at = 0;
    this.pulse.touch();
  }

  private is_due(): boolean {
    const now = this.environment.now();
    const is_at_work = this.parts.commands.open().some((one) => one.component === this.component.value?.ref);
    return is_at_work || now - this.moved_at < rests_after || now - this.reported_at >= period_at_rest;
  }

  private async command(command_type: string, named: Arguments): Promise<Outcome> {
    const { ref } = this.component.value ?? missing();
    const { command_ids, ends } = await this.parts.run(ref, command_type, named);
    const [status = 'unknown'] = await ends;
    const entry = status === 'OK' ? undefined : this.parts.commands.find(command_ids[0]!);
    const results = entry && (await this.parts.commands.fetch_results(entry));
    return { status, reason: results?.text('reason') ?? '' };
  }

  private async look(): Promise<void> {
    const component = this.component.value;
    if (!component) return;
    const results = await this.parts.requests.query('visitors', component.ref);
    const [places, known, steered] = [results.texts('position_data').map(pose_of), results.texts('known'), results.texts('steered')];
    const is = (text: string | undefined) => text === 'true' || text === '1';
    const refs = results.texts('visitor_ref');
    let changed = refs.length !== this.visitors.size || this.reported_at === 0;
    const before = new Map(this.visitors);
    this.visitors.clear();
    refs.forEach((ref, i) => {
      const now = { ref, ...(places[i] ?? { x: 0, y: 0, th: 0 }), known: is(known[i]), steered: is(steered[i]) };
      const previous = before.get(ref);
      changed ||=
        !previous ||
        previous.x !== now.x ||
        previous.y !== now.y ||
        previous.th !== now.th ||
        previous.known !== now.known ||
        previous.steered !== now.steered;
      this.visitors.set(ref, now);
    });
    this.reported_at = this.environment.now();
    if (!changed) return;
    this.moved_at = this.reported_at;
    this.pulse.touch();
  }
}

function target_text(to: string | Omit<Pose, 'th'> | Pose): string {
  if (typeof to === 'string') return to;
  return 'th' in to ? pose_text(to) : `${to.x}, ${to.y}`;
}

function missing(): never {
  throw new RoisError('invalid', 'this engine has no simulated hall');
}
