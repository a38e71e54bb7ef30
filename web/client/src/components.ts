// The basic components (7.6) and the streaming components of RoIS 2.0, with methods for their commands, queries and events. Unless
// noted, lengths are mm, angles degrees counter-clockwise and times ms.
import type { BindOptions, Client } from './client.js';
import { command } from './commands.js';
import { component_ref, component_type, type Condition } from './conditions.js';
import type { ComponentStatus } from './errors.js';
import type { Completion } from './execution.js';
import type { Subscription } from './subscriptions.js';
import { type Arguments, code_of, type Pose, pose_text, type Ref, type Results, type Value, value } from './values.js';

/** A component class with the name of its type. */
export interface ComponentClass<Kind extends Component> {
  new (client: Client, component_ref: Ref): Kind;
  readonly type: string;
}

/** Options of an action. */
export interface ActionOptions {
  deadline?: number; // ms to wait for its end; the action itself continues
}

// An optional int; other numbers are rounded.
function int(n: number | undefined): Value | undefined {
  return n === undefined ? undefined : value.int(n);
}

/** A component of any type: the common messages (RoIS_Common). */
export class Component {
  static readonly type: string = '';

  /** For a component that is already bound, or needs no binding. */
  constructor(
    readonly client: Client,
    readonly component_ref: Ref,
  ) {}

  /** Binds this component. */
  static async bind<Kind extends Component>(
    this: ComponentClass<Kind>,
    client: Client,
    component_ref: Ref,
    options: BindOptions = {},
  ): Promise<Kind> {
    await client.bind(component_ref, options);
    return new this(client, component_ref);
  }

  /** Binds a component of this type that matches the condition. */
  static async bind_any<Kind extends Component>(
    this: ComponentClass<Kind>,
    client: Client,
    condition?: Condition,
    options: BindOptions = {},
  ): Promise<Kind> {
    const of_type = component_type(this.type);
    return new this(client, await client.bind_any(condition?.and(of_type) ?? of_type, options));
  }

  release(): Promise<void> {
    return this.client.release(this.component_ref);
  }

  /** Executes one command and waits for its end. Resolves for a failed command too: see `ok` and `reason`. */
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

  /** Queries this component. Needs no binding. */
  async query(query_type: string): Promise<Results> {
    return (await this.client.query(query_type, component_ref(code_of(this.component_ref)))).results;
  }

  async component_status(): Promise<ComponentStatus> {
    return (await this.query('component_status')).text('status') as ComponentStatus;
  }

  /** Subscribes to this component's events of a type that match the condition. */
  subscribe(event_type: string, condition?: Condition): Promise<Subscription> {
    const mine = component_ref(code_of(this.component_ref));
    return this.client.subscribe(event_type, { condition: condition?.and(mine) ?? mine });
  }
}

/** 7.6.1 */
export class SystemInformation extends Component {
  static override readonly type = 'SystemInformation';

  /** Returns the positions of the robots. */
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

  /** Listens until `stop`. Languages are ISO 639-1 codes. */
  listen(to: { languages?: string[]; grammar?: string; rule?: string } = {}): Promise<Completion> {
    return this.start(to);
  }
}

/** Voice: volume 0 to 100, language as ISO 639-1 code. */
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

  /** Speaks a text. Resolves when it is spoken. */
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

  /** Shows a reaction of annex D, given by number or name. */
  react(reaction_ref: Ref | number, options: ActionOptions = {}): Promise<Completion> {
    const ref = typeof reaction_ref === 'number' ? String(reaction_ref) : reaction_ref;
    return this.start({ reaction_ref: value.identifier(ref) }, options);
  }
}

/** 7.6.13: events `reached_target` with `target`, `is_final_target`. */
export class Navigation extends Component {
  static override readonly type = 'Navigation';

  /** Goes to a pose or named place, or to several in order. Resolves on arrival. */
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

  /** Follows a person or object at this distance, until `stop` or the time limit. */
  follow(target_object_ref: Ref, distance: number, how: { time_limit?: number } & ActionOptions = {}): Promise<Completion> {
    return this.start(
      { target_object_ref: value.identifier(target_object_ref), distance: value.int(distance), time_limit: int(how.time_limit) },
      how,
    );
  }
}

/** 7.6.15 */
export class Move extends Component {
  static override readonly type = 'Move';

  /** Turns on the spot by `turn` degrees (positive: left), then drives `distance` mm straight (negative: backwards). */
  line(distance: number, turn: number, how: { time?: number } & ActionOptions = {}): Promise<Completion> {
    return this.start({ line: value.ints([distance, turn]), time: int(how.time) }, how);
  }

  /**
   * Drives on a circle of `radius` mm (negative: backwards; 0: on the spot) until the heading has turned by `turn` degrees (positive:
   * left).
   */
  curve(radius: number, turn: number, how: { time?: number } & ActionOptions = {}): Promise<Completion> {
    return this.start({ curve: value.ints([radius, turn]), time: int(how.time) }, how);
  }
}

/** RoIS 2.0: events `notify_stream_status` with `stream_id`, `status`. */
export class Streaming extends Component {
  /** Creates a stream. The results are its name, its encoding and its address. */
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
