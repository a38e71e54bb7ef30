// The state of the page and its operations. Panels use only this.
import { signal } from '@preact/signals';
import {
  type Arguments,
  Client,
  code_of,
  command,
  commands_of,
  type CommandUnit,
  type CompletedStatus,
  type Gap,
  type Identifier,
  type Notification,
  type Results,
  type SubscribeOptions,
  type Subscription,
  type Writable,
  type XmlElement,
} from 'rois-client';

import type { Environment, Stop } from './base/environment';
import { reason_of } from './base/reason_of';
import { EverythingState } from './engine/everything';
import { MembersState } from './engine/members_state';
import { MetricsState } from './engine/metrics_state';
import { ParametersState } from './engine/parameters_state';
import { ProfileState } from './engine/profile_state';
import { StatusState } from './engine/status_state';
import { EntitiesState } from './floor/entities_state';
import { MapState } from './floor/floor_map';
import { HallState } from './floor/hall_state';
import { RobotsState } from './floor/robots_state';
import { History } from './history';
import { Notices } from './notices';
import { Selection } from './selection';
import { Bindings } from './session/bindings';
import { CommandsState } from './session/commands_state';
import type { LoggedDocument } from './session/document_log';
import { Documents } from './session/documents';
import { EventsState } from './session/events_state';
import { LinkState } from './session/link_state';
import { OwnRequests } from './session/own_requests';
import { SubscriptionsState } from './session/subscriptions_state';
import { Traffic } from './session/traffic';

/** Commands that the engine has accepted. */
export interface Accepted {
  command_ids: string[];
  /** Resolves with how they end. Rejects if the session is lost first. */
  ends: Promise<CompletedStatus[]>;
}

export interface ExecuteOptions {
  /** Release components bound for these commands when they end. Omit it for work that continues after `start` (detection, ...). */
  give_back?: boolean;
}

/** The outcome of a document sent as text. */
export interface Sent {
  answer: XmlElement;
  document: LoggedDocument | undefined; // as logged
}

const forever = 2 ** 31 - 1; // ms; a timer's limit
const most_delay = 15_000; // ms, longest delay between retries; the user can retry at once

export class Console {
  /** ms since 1970; changes each second, for showing ages. */
  readonly now = signal(0);
  /** Whether this page runs a scenario. Set by the scenario panel. */
  readonly runs_scenario = signal(false);
  readonly notices: Notices;
  readonly link: LinkState;
  readonly documents: Documents;
  readonly profile = new ProfileState();
  readonly status: StatusState;
  readonly parameters: ParametersState;
  readonly metrics: MetricsState;
  readonly members: MembersState;
  readonly bindings: Bindings;
  readonly commands: CommandsState;
  readonly events: EventsState;
  readonly subscriptions: SubscriptionsState;
  readonly robots: RobotsState;
  readonly entities: EntitiesState;
  readonly map: MapState;
  readonly traffic: Traffic;
  readonly history: History;
  readonly hall: HallState;
  readonly everything: EverythingState;
  readonly selection = new Selection();

  private token: string | undefined;
  private current_client: Client | undefined;
  private stops: Stop[] = [];
  private session = '';

  constructor(readonly environment: Environment) {
    const client = () => this.current_client;
    const token = () => this.token;
    this.notices = new Notices(environment);
    this.link = new LinkState(environment);
    this.documents = new Documents(environment);
    const requests = new OwnRequests(environment, this.documents, client, () => this.link.is_open);
    this.status = new StatusState(environment, requests, this.profile);
    this.parameters = new ParametersState(requests);
    // In these phases, the gateway is unreachable.
    const may_fetch = () => !/^(connecting|lost|closed)$/.test(this.link.view.value.phase);
    this.metrics = new MetricsState(environment, token, may_fetch);
    this.everything = new EverythingState(environment, token, this.metrics);
    this.bindings = new Bindings(
      () => this.client,
      () => this.metrics.bound.value,
    );
    this.members = new MembersState(environment, requests, this.profile, this.metrics, () => this.bindings.mine.value);
    this.commands = new CommandsState(environment, this.documents, client, (ref) => this.profile.lasts(ref));
    this.events = new EventsState(environment, this.documents, client);
    this.subscriptions = new SubscriptionsState(
      environment,
      this.documents,
      () => this.client,
      (event_type, error) => this.notices.show('warning', event_type, { detail: reason_of(error), about: event_type }),
    );
    this.robots = new RobotsState(environment, requests, this.profile, () => this.commands.open().length > 0);
    this.entities = new EntitiesState(
      environment,
      (event_type) => this.subscriptions.subscribe_own(event_type),
      (event_type) => this.subscriptions.has_own_results(event_type),
      (event_type) => this.profile.with_event(event_type).length > 0,
      (ref) => this.profile.component(ref)?.engine ?? '',
    );
    this.map = new MapState(environment, token);
    this.traffic = new Traffic(environment, requests, this.documents);
    this.history = new History(environment, this);
    this.hall = new HallState(environment, {
      requests,
      commands: this.commands,
      profile: this.profile,
      run: (ref, command_type, named) => this.run(ref, command_type, named, { give_back: true }),
    });
    this.now.value = environment.now();
    environment.every(1000, () => (this.now.value = environment.now()));
    this.documents.is_own_subscription = (id) => this.subscriptions.is_own(id);
    this.documents.listen((document) => this.on_document(document));
  }

  /** ms since 1970. Unlike `now`, not up to a second old. A component that reads it while rendering is rendered again each second. */
  time(): number {
    return Math.max(this.now.value, this.environment.now());
  }

  // --- The link ---

  /** The client, for operations that are missing below. */
  get client(): Client {
    if (!this.current_client) throw new Error('not connected: call connect first');
    return this.current_client;
  }

  /** The current token, for curl lines and HTTP requests. */
  get current_token(): string | undefined {
    return this.token;
  }

  /** Connects, or reconnects with another token. Retries until it succeeds or the gateway requires a token. */
  connect(token?: string): void {
    this.leave();
    this.token = token;
    // Bindings are not repeated: borrowers bind again in the new session.
    const options = { most_delay, rebind: false, switches: true, ...(token !== undefined && { token }) };
    let client: Client;
    try {
      client = new Client(this.environment.origin, options, this.environment.open_socket);
    } catch (error) {
      this.token = undefined; // it is not sent without TLS
      this.link.set_phase('token', reason_of(error));
      return;
    }
    this.current_client = client;
    this.stops = [
      this.link.follow(client, token, () => void client.close({ deadline: 0 })), // first: the others ask whether it is open
      client.on('document', ({ direction, text }) => this.documents.note(direction, text)),
      client.on('state', ({ state }) => this.link_changed(state)),
      client.on('gap', (gap) => this.missed(gap)),
      client.on('notification', (notification) => this.notified(notification)),
    ];
    client.start(forever).catch(() => undefined); // reported by the link's state
  }

  /** Retries at once to open a lost link. */
  retry(): void {
    this.current_client?.retry();
  }

  /** Ends the session at once. The engine stops its commands. */
  async close(): Promise<void> {
    const client = this.current_client;
    await client?.close({ deadline: 1000 });
    this.link.set_phase('closed', '');
  }

  private leave(): void {
    for (const stop of this.stops.splice(0)) stop();
    void this.current_client?.close({ deadline: 1000 });
    this.forget_session();
  }

  private link_changed(state: string): void {
    if (state === 'lost' || state === 'connecting' || state === 'closed') this.documents.forget_waiting();
    if (state === 'closed') {
      this.forget_session();
      this.status.all.value = new Map();
      this.metrics.latest.value = undefined;
    }
    if (state !== 'open' && state !== 'resumed') return;
    if (this.session !== '' && this.session !== this.client.session) this.forget_session();
    this.session = this.client.session;
    void this.read_profile();
    void this.map.load();
    this.status.poll.now();
    this.metrics.poll.now();
  }

  private missed(gap: Gap): void {
    if (gap.reason === 'buffer') return;
    if (gap.reason === 'session') this.forget_session();
    this.events.gap(gap);
  }

  private forget_session(): void {
    this.session = '';
    this.bindings.forget();
    this.commands.forget_session();
    this.subscriptions.forget_session();
    this.entities.forget();
    this.robots.forget();
    this.hall.forget();
  }

  private async read_profile(): Promise<void> {
    try {
      this.profile.update(await this.documents.as_own(() => this.client.get_profile()), this.environment.now());
      this.entities.profile_changed();
      void this.members.read();
      this.status.poll.now();
      this.notices.dismiss('profile');
    } catch (error) {
      if (this.link.is_open) this.notices.show('error', reason_of(error), { about: 'profile' });
    }
  }

  // --- Received documents ---

  private on_document(document: LoggedDocument): void {
    if (document.kind !== 'answer') return;
    this.bindings.on_answer(document);
    this.commands.on_answer(document);
    this.subscriptions.on_answer(document);
  }

  private notified(notification: Notification): void {
    const { number: document, is_own } = this.documents.ring.last!; // a document is logged before it is processed
    switch (notification.name) {
      case 'receive_event':
        this.events.event(notification, document, is_own);
        this.subscriptions.event(notification);
        this.entities.event(notification);
        break;
      case 'receive_error':
        this.events.error(notification, document);
        this.metrics.poll.now(); // everything may have been stopped
        break;
      case 'completed':
        this.commands.ended(notification.command_id, notification.status, document);
        break;
      case 'profile_changed':
        void this.read_profile();
        break;
      case 'switched':
        this.events.switched(notification, document);
        this.members.on_switched(notification);
        break;
      case 'lost':
        break; // reported as a gap
    }
  }

  // --- Operations. Each rejects with RoisError. ---

  /** Executes commands. Binds unbound components first. */
  async execute(units: readonly CommandUnit[], { give_back = false }: ExecuteOptions = {}): Promise<Accepted> {
    const refs = commands_of(units).map((one) => code_of(one.component_ref));
    const back = give_back ? await this.bindings.borrow(refs) : await this.bind_all(refs);
    try {
      const execution = await this.client.execute(units);
      const ends = execution.statuses().finally(() => back().catch(() => undefined));
      ends.catch(() => undefined); // the caller may ignore it
      return { command_ids: execution.command_ids, ends };
    } catch (error) {
      await back();
      throw error;
    }
  }

  /** Executes one command. */
  run(ref: string, command_type: string, named: Arguments = {}, options: ExecuteOptions = {}): Promise<Accepted> {
    return this.execute([command(ref, command_type, named)], options);
  }

  /** Sets parameters of a component. Binds it first if needed. */
  async set_parameter(ref: string, named: Arguments): Promise<Accepted> {
    await this.bindings.bind(ref);
    const execution = await this.client.set_parameter(ref, named);
    const ends = execution.statuses();
    ends.catch(() => undefined);
    return { command_ids: execution.command_ids, ends };
  }

  query(query_type: string, condition?: Writable): Promise<{ component_ref: Identifier; results: Results }> {
    return this.client.query(query_type, condition);
  }

  search(condition?: Writable): Promise<Identifier[]> {
    return this.client.search(condition);
  }

  /** Subscribes until `subscriptions.unsubscribe`, across sessions. Events go to `events` and the other state. */
  subscribe(event_type: string, options: SubscribeOptions = {}): Promise<Subscription> {
    return this.subscriptions.subscribe(event_type, options);
  }

  /** Sends a document unchanged and returns the answer. Rejects if the link breaks or the client may not send it. */
  async send(text: string): Promise<Sent> {
    let sent: LoggedDocument | undefined;
    let document: LoggedDocument | undefined;
    const stop = this.documents.listen((one) => {
      if (sent === undefined && one.direction === 'out' && one.text === text) sent = one;
      if (sent !== undefined && one.request === sent) document = one;
    });
    try {
      return { answer: await this.client.send(text), document };
    } finally {
      stop();
    }
  }

  private async bind_all(refs: readonly string[]): Promise<() => Promise<void>> {
    for (const ref of new Set(refs)) await this.bindings.bind(ref);
    return () => Promise.resolve();
  }
}
