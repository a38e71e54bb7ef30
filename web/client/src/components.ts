// The basic components (7.6) and those of 2.0 that stream, with their commands, queries and events as methods. Lengths are mm,
// angles degrees counter-clockwise, times ms, unless something else is said.
import type { Client } from './client.js';
import { command } from './commands.js';
import { component_ref, component_type, type Condition } from './conditions.js';
import type { ComponentStatus } from './errors.js';
import type { Completion } from './execution.js';
import type { Subscription } from './subscriptions.js';
import { type Arguments, code_of, type Pose, pose_text, type Ref, type Results, type Value, value } from './values.js';

/** A kind of component: the class and the name of its type. */
export interface ComponentClass<Kind extends Component> {
  new (client: Client, component_ref: Ref): Kind;
  readonly type: string;
}

/** How long an action may take. */
export interface ActionOptions {
  deadline?: number; // ms until its end is waited for no longer; it goes on
}

// An int that may be left out; numbers of other kinds are rounded.
function int(n: number | undefined): Value | undefined {
  return n === undefined ? undefined : value.int(n);
}

/** Any component, by name; what all have (RoIS_Common). */
export class Component {
  static readonly type: string = '';

  /** One that is bound already, or needs no binding. */
  constructor(
    readonly client: Client,
    readonly component_ref: Ref,
  ) {}

  /** Binds this one. */
  static async bind<Kind extends Component>(this: ComponentClass<Kind>, client: Client, component_ref: Ref): Promise<Kind> {
    await client.bind(component_ref);
    return new this(client, component_ref);
  }

  /** Binds any of this type that meets the condition. */
  static async bind_any<Kind extends Component>(this: ComponentClass<Kind>, client: Client, condition?: Condition): Promise<Kind> {
    const of_type = component_type(this.type);
    return new this(client, await client.bind_any(condition?.and(of_type) ?? of_type));
  }

  release(): Promise<void> {
    return this.client.release(this.component_ref);
  }

  /** Executes one command and waits for its end. A command that fails fulfils the promise, too: see `ok` and `reason`. */
  async run(command_type: string, named: Arguments = {}, options: ActionOptions = {}): Promise<Completion> {
    const execution = await this.client.execute([command(this.component_ref, command_type, named)]);
    return execution.completion(options.deadline);
  }

  start(named: Arguments = {}, options: ActionOptions = {}): Promise<Completion> {
    return this.run('start', named, options);
  }
  stop(): Promise<Completion> {
    return this.run('stop');
  }
  suspend(): Promise<Completion> {
    return this.run('suspend');
  }
  resume(): Promise<Completion> {
    return this.run('resume');
  }

  async set(named: Arguments): Promise<Completion> {
    return (await this.client.set_parameter(this.component_ref, named)).completion();
  }
  get(): Promise<Results> {
    return this.client.get_parameter(this.component_ref);
  }

  /** Asks this component; needs no binding. */
  async query(query_type: string): Promise<Results> {
    return (await this.client.query(query_type, component_ref(code_of(this.component_ref)))).results;
  }

  async component_status(): Promise<ComponentStatus> {
    return (await this.query('component_status')).text('status') as ComponentStatus;
  }

  /** This component's events of a type, those that meet the condition. */
  subscribe(event_type: string, condition?: Condition): Promise<Subscription> {
    const mine = component_ref(code_of(this.component_ref));
    return this.client.subscribe(event_type, { condition: condition?.and(mine) ?? mine });
  }
}

/** 7.6.1 */
export class SystemInformation extends Component {
  static override readonly type = 'SystemInformation';

  /** Where the robots are. */
  async robot_position(): Promise<Pose[]> {
    return (await this.query('robot_position')).poses('position_data');
  }
  async engine_status(): Promise<ComponentStatus> {
    return (await this.query('engine_status')).text('status') as ComponentStatus;
  }
}

/** 7.6.2: events `person_detected` with `number`. */
export class PersonDetection extends Component {
  static override readonly type = 'PersonDetection';
}
/** 7.6.3: events `person_localized` with `person_ref`, `position_data`. */
export class PersonLocalization extends Component {
  static override readonly type = 'PersonLocalization';
}
/** 7.6.4: events `person_identified` with `person_ref`. */
export class PersonIdentification extends Component {
  static override readonly type = 'PersonIdentification';
}
/** 7.6.5: events `face_detected` with `number`. */
export class FaceDetection extends Component {
  static override readonly type = 'FaceDetection';
}
/** 7.6.6: events `face_localized` with `face_ref`, `position_data`. */
export class FaceLocalization extends Component {
  static override readonly type = 'FaceLocalization';
}
/** 7.6.7: events `sound_detected` with `number`. */
export class SoundDetection extends Component {
  static override readonly type = 'SoundDetection';
}
/** 7.6.8: events `sound_localized` with `sound_ref`, `position_data`. */
export class SoundLocalization extends Component {
  static override readonly type = 'SoundLocalization';
}
/** 7.6.10: events `gesture_recognized` with `gesture_ref`. */
export class GestureRecognition extends Component {
  static override readonly type = 'GestureRecognition';
}

/** 7.6.9: events `speech_recognized` with `recognized_text`, `speech_input_started`, `speech_input_finished`. */
export class SpeechRecognition extends Component {
  static override readonly type = 'SpeechRecognition';

  /** Begins to listen; ends with `stop`. Languages are of ISO 639-1. */
  listen(to: { languages?: string[]; grammar?: string; rule?: string } = {}): Promise<Completion> {
    return this.start(to);
  }
}

/** How something is said: the volume is 0 to 100, the language of ISO 639-1. */
export interface VoiceOptions extends ActionOptions {
  volume?: number;
  language?: string;
  character?: string;
}

function voice({ volume, language, character }: VoiceOptions): Arguments {
  return { volume: int(volume), language, character };
}

/** 7.6.11 */
export class SpeechSynthesis extends Component {
  static override readonly type = 'SpeechSynthesis';

  /** Says a text; done when it is said. */
  say(text: string, how: VoiceOptions = {}): Promise<Completion> {
    return this.start({ speech_text: text, ...voice(how) }, how);
  }
  say_ssml(document: string, how: VoiceOptions = {}): Promise<Completion> {
    return this.start({ SSML_text: document, ...voice(how) }, how);
  }
}

/** 7.6.12 */
export class Reaction extends Component {
  static override readonly type = 'Reaction';

  /** Shows a reaction of annex D: its number or its name. */
  react(reaction_ref: Ref | number, options: ActionOptions = {}): Promise<Completion> {
    const ref = typeof reaction_ref === 'number' ? String(reaction_ref) : reaction_ref;
    return this.start({ reaction_ref: value.identifier(ref) }, options);
  }
}

/** 7.6.13: events `reached_target` with `target`, `is_final_target`. */
export class Navigation extends Component {
  static override readonly type = 'Navigation';

  /** Goes to a pose, to a named place, or to several one after the other; done on arrival. */
  go_to(
    where: Pose | string | (Pose | string)[],
    how: { time_limit?: number; routing_policy?: 'time' | 'distance' } & ActionOptions = {},
  ): Promise<Completion> {
    const { time_limit, routing_policy } = how;
    const targets = (Array.isArray(where) ? where : [where]).map((one) => (typeof one === 'string' ? one : pose_text(one)));
    return this.start({ target_position: value.strings(targets), time_limit: int(time_limit), routing_policy }, how);
  }
}

/** 7.6.14 */
export class Follow extends Component {
  static override readonly type = 'Follow';

  /** Follows somebody or something at this distance, until `stop` or until the time is over. */
  follow(target_object_ref: Ref, distance: number, how: { time_limit?: number } & ActionOptions = {}): Promise<Completion> {
    return this.start({ target_object_ref: value.identifier(target_object_ref), distance: value.int(distance), time_limit: int(how.time_limit) }, how);
  }
}

/** 7.6.15 */
export class Move extends Component {
  static override readonly type = 'Move';

  /** Turns on the spot by `turn` degrees (to the left when positive), then drives `distance` mm straight on, backwards when negative. */
  line(distance: number, turn: number, how: { time?: number } & ActionOptions = {}): Promise<Completion> {
    return this.start({ line: value.ints([distance, turn]), time: int(how.time) }, how);
  }

  /**
   * Drives along a circle of `radius` mm until the heading has changed by `turn` degrees (to the left when positive). A negative
   * radius drives backwards; 0 turns on the spot.
   */
  curve(radius: number, turn: number, how: { time?: number } & ActionOptions = {}): Promise<Completion> {
    return this.start({ curve: value.ints([radius, turn]), time: int(how.time) }, how);
  }
}

/** Of RoIS 2.0: events `notify_stream_status` with `stream_id`, `status`. */
export class Streaming extends Component {
  /** Makes a stream: its name, its encoding, and where it is fetched or sent. */
  async connect_stream(options: ActionOptions = {}): Promise<Results> {
    const execution = await this.client.execute([command(this.component_ref, 'connect_stream')]);
    await execution.status(options.deadline);
    return this.client.get_command_result(execution.command_ids[0]!);
  }
  disconnect_stream(stream_id: string): Promise<Completion> {
    return this.run('disconnect_stream', { stream_id });
  }
  suspend_stream(stream_id: string): Promise<Completion> {
    return this.run('suspend_stream', { stream_id });
  }
  resume_stream(stream_id: string): Promise<Completion> {
    return this.run('resume_stream', { stream_id });
  }
}
export class AudioStreaming extends Streaming {
  static override readonly type = 'AudioStreaming';
}
export class VideoStreaming extends Streaming {
  static override readonly type = 'VideoStreaming';
}
