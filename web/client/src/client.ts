// Client: the RoIS interfaces (tables 2 to 6) for a service application.
import { component_ref_of, identifier_of, parameter_of, profile_of, results_of, trouble_of } from './answers.js';
import { type CommandUnit, commands_of, named } from './commands.js';
import { all_of, component_type, property } from './conditions.js';
import { type CompletedStatus, RoisError } from './errors.js';
import { Commands, Execution } from './execution.js';
import { Link, type LinkSettings, type State } from './link.js';
import { Listeners } from './listeners.js';
import type { Gap, Notification } from './messages.js';
import type { Profile } from './profiles.js';
import { component_ref_xml, condition_xml, type Operation, parameter_xml, sequence_xml, type Writable } from './requests.js';
import { type OpenSocket, socket_url } from './socket.js';
import { Stream } from './stream.js';
import { Subscription, Subscriptions, type Wanted } from './subscriptions.js';
import { for_timer } from './times.js';
import { type Arguments, code_of, type Identifier, parameters_of, type Ref, Results } from './values.js';
import { element, text_element, type XmlElement } from './xml.js';

/** Options of a client. All are optional; defaults in brackets. */
export interface ClientOptions {
  /** Bearer token. Sent as the second subprotocol, because a page cannot set headers. */
  token?: string;
  /** Timeout of a call in ms [10,000], unless the call sets its own. */
  deadline?: number;
  /** Silence in ms before a ping [10,000]. The link is dropped after the same time again without an answer. */
  heartbeat?: number;
  /**
   * Motion lease in ms, 1000 to the gateway's own [2000]: a robot that this session moves is held after this time without a sign of life.
   */
  motion_lease?: number;
  /** Receive each `switched` [false], not only those of components that this client has bound with `switching`. */
  switches?: boolean;
  /** Delay in ms before the first retry [100]. Each further retry doubles it; each delay is shortened by up to half at random. */
  first_delay?: number;
  /** Longest delay between two retries in ms [5,000]. */
  most_delay?: number;
  /** Bind the components of a lost session again [true]. */
  rebind?: boolean;
  /** Capacity of each stream of notifications [10,000]. A full stream drops the oldest one and reports a gap. */
  buffer?: number;
  /**
   * A listener of `on('state')` from the first attempt on: each failed attempt is reported as `connecting` or `lost` while `connect`
   * retries.
   */
  on_state?: (change: StateChange) => void;
  /** Random number from 0 to 1, used to shorten the delays [Math.random]. */
  random?: () => number;
}

/** Options of one call. */
export interface CallOptions {
  deadline?: number; // ms
}

/**
 * What happens to a `start` when the member that acts for a logical component fails. none: it ends as it ended there. abort: it
 * ends with ABORT. restart: another member goes on with the rest.
 */
export type Switching = 'none' | 'abort' | 'restart';

export interface BindOptions extends CallOptions {
  /** [none] Also used when a new session binds the component again. */
  switching?: Switching | undefined;
}

// Options of one request. `of`: the timeout of the whole call, when it takes several requests.
type RequestOptions = CallOptions & { of?: number };

export interface SubscribeOptions extends CallOptions {
  condition?: Writable;
  /** Whether events carry their results [true]. */
  inline_results?: boolean;
}

/** The new state of the link. `reason` is empty when the link is open. */
export interface StateChange {
  state: State;
  reason: string;
}

/** The kinds of news for `on`, with what a listener receives. */
export interface ClientNews {
  state: StateChange;
  gap: Gap;
  notification: Notification;
  /** A new session could not bind this component again: another session has it, or it no longer exists. */
  unbound: { component_ref: string; error: RoisError };
  /** Every document sent or received. */
  document: { direction: 'in' | 'out'; text: string };
}

const close_within = 3000; // ms

export class Client {
  private readonly listeners = new Listeners<ClientNews>();
  private readonly link: Link;
  private readonly deadline: number;
  private readonly rebind: boolean;
  private readonly buffer: number;
  private readonly commands = new Commands();
  private readonly subscriptions = new Subscriptions();
  private readonly streams = new Set<Stream<Notification>>();
  private readonly bound = new Map<string, Switching | undefined>();
  private readonly prefix = Math.random().toString(36).slice(2, 8); // of command ids, which must be unique among the clients of a session
  private next_command = 1;

  /** Does not connect; the package's `connect` constructs and connects. */
  constructor(url: string, options: ClientOptions, open_socket: OpenSocket) {
    this.buffer = options.buffer ?? 10_000;
    this.deadline = options.deadline ?? 10_000;
    this.rebind = options.rebind ?? true;
    const settings: LinkSettings = {
      url: socket_url(url, options.token),
      deadline: this.deadline,
      heartbeat: options.heartbeat ?? 10_000,
      first_delay: options.first_delay ?? 100,
      most_delay: options.most_delay ?? 5000,
      random: options.random ?? Math.random,
      open_socket,
    };
    if (options.token !== undefined) settings.token = options.token;
    if (options.motion_lease !== undefined) settings.motion_lease = options.motion_lease;
    if (options.switches) settings.switches = true;
    if (options.on_state) this.on('state', options.on_state);
    this.link = new Link(settings, {
      state_changed: (state, reason) => this.listeners.notify('state', { state, reason }),
      session_began: () => this.restore(),
      session_ended: (error) => this.ended(error),
      notified: (notification) => this.notified(notification),
      missed: (gap) => this.listeners.notify('gap', gap),
      document: (direction, text) => this.listeners.notify('document', { direction, text }),
    });
  }

  /** Connects and waits for the session. Rejects with `unreachable` after `deadline` ms; the client is then closed. */
  start(deadline = 10_000): Promise<void> {
    return new Promise((resolve, reject) => {
      let reason = 'no answer';
      const stop = this.on('state', (change) => {
        if (change.state === 'connecting') reason = change.reason;
        if (change.state === 'connecting') return;
        clearTimeout(timer);
        stop();
        if (change.state === 'closed') reject(new RoisError('unreachable', change.reason));
        else resolve();
      });
      const timer = setTimeout(
        () => this.link.finish(new RoisError('unreachable', `no session within ${deadline} ms: ${reason}`)),
        for_timer(deadline),
      );
      this.link.start();
    });
  }

  // --- The link ---

  get state(): State {
    return this.link.current_state;
  }

  /** Retries at once if the link is lost. Otherwise does nothing. */
  retry(): void {
    this.link.retry();
  }

  /** The session's id; empty while there is none. */
  get session(): string {
    return this.link.session_id;
  }

  /** Adds a listener. Returns a function that removes it. */
  on<Kind extends keyof ClientNews>(kind: Kind, listener: (news: ClientNews[Kind]) => void): () => void {
    return this.listeners.add(kind, listener);
  }

  /** Returns a stream of all notifications from now on. It ends when the client is closed or the stream is ended. */
  notifications(): Stream<Notification> {
    const stream = new Stream<Notification>(this.buffer, (count) => this.dropped(count));
    this.streams.add(stream);
    return stream;
  }

  /** Ends the session (`disconnect`) and closes the client. If the link is lost, waits for it up to `deadline` [3 s]. */
  close(options: CallOptions = {}): Promise<void> {
    return this.link.close(options.deadline ?? close_within);
  }

  /**
   * Sends any document and returns the answer, a response or a fault. Not repeated when the link breaks. A `disconnect` closes the
   * client; `resume` is rejected as `invalid`, because the client resumes its session itself.
   */
  async send(text: string, options: CallOptions = {}): Promise<XmlElement> {
    if (/<(?:[^\s<>/:]+:)?resume[\s/>]/.test(text))
      throw new RoisError('invalid', "'resume' cannot be sent: the client resumes its session itself");
    return this.link.send(text, options.deadline);
  }

  // --- System interface (table 2) ---

  get_profile(condition?: Writable, options: CallOptions = {}): Promise<Profile> {
    return this.ask('get_profile', () => condition_xml(condition), options, profile_of);
  }

  get_error_detail(error_id: string, condition?: Writable, options: CallOptions = {}): Promise<Results> {
    return this.ask('get_error_detail', () => text_element('error_id', error_id) + condition_xml(condition), options, results_of);
  }

  // --- Command interface (table 3) ---

  search(condition?: Writable, options: CallOptions = {}): Promise<Identifier[]> {
    return this.ask('search', () => condition_xml(condition), options, (answer) =>
      (answer.child('component_ref_list')?.all('component_ref') ?? []).map(identifier_of),
    );
  }

  /** `take_over`: also from another session that has bound the component, which is halted first; for administrators. */
  bind(component_ref: Ref, options: BindOptions & { take_over?: boolean } = {}): Promise<void> {
    const { switching } = options;
    const take_over = options.take_over === true ? 'true' : undefined;
    const taken = () => void this.bound.set(code_of(component_ref), switching);
    return this.asked('bind', { switching, take_over }, () => component_ref_xml(component_ref), options, taken, true);
  }

  /** Binds a component that matches the condition, or one of the named type. May return a component that this session has already bound. */
  async bind_any(condition?: Writable | string, options: BindOptions = {}): Promise<Identifier> {
    const meant = typeof condition === 'string' ? component_type(condition) : condition;
    const deadline = this.deadline_of(options);
    const { switching } = options;
    const taken = (component: Identifier) => {
      this.bound.set(component.code, switching);
      return component;
    };
    for (;;) {
      try {
        const read = (answer: XmlElement) => taken(component_ref_of(answer));
        return await this.asked('bind_any', { switching }, () => condition_xml(meant), deadline(), read, false);
      } catch (error) {
        if (!is_failure(error, 'link_lost')) throw error;
        const mine = await this.bound_unawares(meant, deadline());
        if (mine) return taken(mine);
      }
    }
  }

  release(component_ref: Ref, options: CallOptions = {}): Promise<void> {
    const forget = () => void this.bound.delete(code_of(component_ref));
    forget(); // so that a session lost before the answer does not bind it again
    return this.ask('release', () => component_ref_xml(component_ref), options, forget);
  }

  get_parameter(component_ref: Ref, options: CallOptions = {}): Promise<Results> {
    return this.ask(
      'get_parameter',
      () => component_ref_xml(component_ref),
      options,
      (answer) => new Results((answer.child('parameters')?.all('parameter') ?? []).map(parameter_of)),
    );
  }

  set_parameter(component_ref: Ref, parameters: Arguments, options: CallOptions = {}): Promise<Execution> {
    const list = () => element('parameters', {}, ...parameters_of(parameters).map((one) => parameter_xml(one)));
    return this.ask('set_parameter', () => component_ref_xml(component_ref) + list(), options, (answer) => {
      const id = answer.text_of('command_id');
      return this.execution([id], [this.commands.expect(id)]);
    });
  }

  /**
   * Executes commands. The client names each unnamed command. If the link breaks before the answer, it looks the names up, so that
   * commands are executed once or not at all.
   */
  async execute(units: readonly CommandUnit[], options: CallOptions = {}): Promise<Execution> {
    const sequence = named(units, () => `${this.prefix}-${this.next_command++}`);
    const ids = commands_of(sequence).map((one) => one.command_id);
    const fresh = ids.filter((id) => !this.commands.is_used(id));
    const ends = ids.map((id) => this.commands.expect(id));
    try {
      await this.execute_once(() => sequence_xml(sequence), fresh[0], this.deadline_of(options));
    } catch (error) {
      this.commands.forget(fresh);
      throw error;
    }
    this.commands.use(ids);
    return this.execution(ids, ends);
  }

  get_command_result(command_id: string, condition?: Writable, options: CallOptions = {}): Promise<Results> {
    return this.ask('get_command_result', () => text_element('command_id', command_id) + condition_xml(condition), options, results_of);
  }

  // --- Query interface (table 4) ---

  /** Queries the engine, or a component that matches the condition. The result names the component. */
  query(query_type: string, condition?: Writable, options: CallOptions = {}): Promise<{ component_ref: Identifier; results: Results }> {
    return this.ask('query', () => text_element('query_type', query_type) + condition_xml(condition), options, (answer) => ({
      component_ref: component_ref_of(answer),
      results: results_of(answer),
    }));
  }

  // --- Event interface (table 5) ---

  subscribe(event_type: string, options: SubscribeOptions = {}): Promise<Subscription> {
    const wanted: Wanted = { event_type, condition: options.condition, inline_results: options.inline_results ?? true };
    const subscription = new Subscription(
      wanted,
      this.buffer,
      (count) => this.dropped(count),
      (one) => this.leave(one),
    );
    return this.ask_to_subscribe(subscription, options);
  }

  get_event_detail(event_id: string, condition?: Writable, options: CallOptions = {}): Promise<Results> {
    return this.ask('get_event_detail', () => text_element('event_id', event_id) + condition_xml(condition), options, results_of);
  }

  // --- Inside ---

  private ask<T>(
    operation: Operation,
    content: () => string,
    options: RequestOptions,
    read: (answer: XmlElement) => T,
    repeatable = true,
  ): Promise<T> {
    return this.asked(operation, {}, content, options, read, repeatable);
  }

  private asked<T>(
    operation: Operation,
    attributes: Record<string, string | boolean | undefined>,
    content: () => string,
    { deadline, of }: RequestOptions,
    read: (answer: XmlElement) => T,
    repeatable: boolean,
  ): Promise<T> {
    const checked = (answer: XmlElement) => {
      const trouble = trouble_of(answer);
      if (trouble) throw trouble;
      return read(answer);
    };
    return this.link.ask(operation, attributes, content, { deadline, of, repeatable, read: checked });
  }

  private execution(ids: string[], ends: Promise<CompletedStatus>[]): Execution {
    const reason_of = (id: string) =>
      this.get_command_result(id).then(
        (results) => results.text('reason') ?? '',
        () => '', // without the reason, the status is still useful
      );
    return new Execution(ids, ends, reason_of);
  }

  // Returns the time left of a call that takes several requests.
  private deadline_of({ deadline = this.deadline }: CallOptions): () => RequestOptions {
    const end = performance.now() + deadline;
    return () => ({ deadline: Math.max(0, end - performance.now()), of: deadline });
  }

  private async execute_once(sequence: () => string, id: string | undefined, deadline: () => RequestOptions): Promise<void> {
    for (let sent = 1; ; ++sent) {
      try {
        return await this.ask('execute', sequence, deadline(), () => undefined, false);
      } catch (error) {
        const refused = is_failure(error, 'refused');
        const unsure = is_failure(error, 'link_lost') || (refused && sent > 1);
        if (!unsure || id === undefined) throw error;
        if (await this.is_known(id, deadline())) return;
        if (refused) throw error;
      }
    }
  }

  private is_known(command_id: string, options: RequestOptions): Promise<boolean> {
    return this.get_command_result(command_id, undefined, options).then(
      () => true,
      (error: unknown) => {
        if (is_failure(error, 'refused')) return false;
        throw error;
      },
    );
  }

  // The component that a bind_any bound although its answer was lost: it matches, belongs to this session and is not in `bound`.
  private async bound_unawares(condition: Writable | undefined, options: RequestOptions): Promise<Identifier | undefined> {
    const is_mine = all_of(property('bound').equals('true'), property('status').differs_from('BUSY'));
    const [meant, mine] = await Promise.all([this.search(condition, options), this.search(is_mine, options)]);
    return meant.find(({ code }) => mine.some((one) => one.code === code) && !this.bound.has(code));
  }

  private ask_to_subscribe(subscription: Subscription, options: CallOptions): Promise<Subscription> {
    const { event_type, condition, inline_results } = subscription.wanted;
    const content = () => text_element('event_type', event_type) + condition_xml(condition);
    return this.asked('subscribe', { inline_results }, content, options, (answer) => {
      this.subscriptions.add(subscription, answer.text_of('subscribe_id'));
      if (subscription.ended) this.leave(subscription).catch(() => undefined); // closed during the request
      return subscription;
    }, true);
  }

  private async leave(subscription: Subscription): Promise<void> {
    const { subscribe_id } = subscription;
    if (!this.subscriptions.remove(subscription)) return;
    await this.ask('unsubscribe', () => text_element('subscribe_id', subscribe_id), {}, () => undefined).catch((error: unknown) => {
      if (!is_failure(error, 'session_lost') && !is_failure(error, 'closed')) throw error;
    });
  }

  // Binds and subscribes again in a new session, each once. If that session is lost too, the next one repeats it.
  private restore(): void {
    const again = (asked: Promise<unknown>, refused: (error: RoisError) => void) =>
      asked.catch((error: RoisError) => {
        if (!is_failure(error, 'session_lost') && !is_failure(error, 'closed')) refused(error);
      });
    for (const [code, switching] of this.bound)
      again(this.asked('bind', { switching }, () => component_ref_xml(code), { deadline: Infinity }, () => undefined, true), (error) => {
        if (this.bound.delete(code)) this.listeners.notify('unbound', { component_ref: code, error });
      });
    for (const subscription of this.subscriptions.list())
      again(this.ask_to_subscribe(subscription, { deadline: Infinity }), (error) => {
        this.subscriptions.remove(subscription);
        subscription.end(error);
      });
  }

  private ended(error: RoisError): void {
    this.commands.fail(error);
    if (!this.rebind) this.bound.clear();
    this.subscriptions.forget_ids();
    if (error.failure === 'session_lost') return;
    for (const stream of [...this.subscriptions.list(), ...this.streams]) stream.end();
    this.streams.clear();
  }

  private notified(notification: Notification): void {
    if (notification.name === 'completed') this.commands.completed(notification);
    if (notification.name === 'receive_event') this.subscriptions.notify(notification);
    for (const stream of this.streams) {
      if (stream.ended) this.streams.delete(stream);
      else stream.push(notification);
    }
    this.listeners.notify('notification', notification);
  }

  private dropped(count: number): void {
    this.listeners.notify('gap', { reason: 'buffer', count });
  }
}

function is_failure(error: unknown, failure: RoisError['failure']): error is RoisError {
  return error instanceof RoisError && error.failure === failure;
}
