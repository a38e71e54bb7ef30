// The link to the gateway: one session over successive WebSockets. It detects a dead link, reconnects, resumes the session, repeats
// unanswered calls where that is safe, and passes on each notification once.
import { is_notification, notification_of, trouble_of } from './answers.js';
import { RoisError } from './errors.js';
import type { Gap, Notification } from './messages.js';
import { type Operation, request } from './requests.js';
import { type OpenSocket, type Socket, type SocketEnd, subprotocols_with } from './socket.js';
import { for_timer } from './times.js';
import { parse_xml, type XmlElement, XmlError } from './xml.js';

/**
 * State of the link:
 * - `connecting`: first connection; calls wait;
 * - `open`: connected with a new session;
 * - `lost`: the link broke and is being reopened; calls wait;
 * - `resumed`: connected again with the same session; missed notifications follow;
 * - `closed`: closed for good.
 */
export type State = 'connecting' | 'open' | 'lost' | 'resumed' | 'closed';

export interface LinkSettings {
  url: string; // ws: or wss:
  token?: string;
  deadline: number; // ms, timeout of a call that sets none
  heartbeat: number; // ms of silence before a ping; the link is dropped after the same time again
  first_delay: number; // ms before the first retry; each further retry doubles it
  most_delay: number; // ms
  random: () => number; // 0 to 1: shortens each delay by up to half, so that many clients do not reconnect at once
  motion_lease?: number; // ms without a sign of life until a robot is held; at most the gateway's
  switches?: boolean; // receive each `switched`
  open_socket: OpenSocket;
}

export interface LinkListener {
  state_changed(state: State, reason: string): void;
  /** A new session has begun. Calls made here are sent before those that wait. */
  session_began(): void;
  /** The session is lost. All waiting calls have failed. */
  session_ended(error: RoisError): void;
  notified(notification: Notification): void;
  missed(gap: Gap): void;
  document(direction: 'in' | 'out', text: string): void;
}

/** Options of a call. */
export interface AskOptions<T> {
  deadline?: number | undefined; // ms
  /** The timeout to name in the error, if `deadline` is only the rest of it. */
  of?: number | undefined; // ms
  /** Send again if the link breaks before the answer. Otherwise the call fails with `link_lost`. */
  repeatable: boolean;
  /** Converts the answer to the result, before any later document is processed. */
  read(answer: XmlElement): T;
}

interface Call {
  text: string;
  request_id: string | undefined;
  repeatable: boolean;
  sent_at: number;
  settled: boolean; // the caller has its result
  answered(answer: XmlElement): void;
  failed(error: RoisError): void;
}

const usual_lease = 2000; // ms, the gateway's default
const open_within = 10_000; // ms to open a WebSocket and begin or resume a session

export class Link {
  private state: State = 'connecting';
  private reason = ''; // why the link is not open
  private session = '';
  private last_sequence = 0; // of the session
  private socket: Socket | undefined;
  private ready = false; // the session exists, and calls may be sent
  private queue: Call[] = []; // not yet sent
  private in_flight: Call[] = []; // sent and unanswered, in order
  private last_received_at = 0;
  private last_sent_at = 0;
  private may_move = false; // this session has sent `bind` or `execute`
  private proving = false; // a ping is unanswered
  private tries = 0; // failed attempts since the last session
  private next_id = 1;
  private closing: Promise<void> | undefined;
  private attempt_timer: ReturnType<typeof setTimeout> | undefined; // for the next attempt, or for the end of this one
  private heartbeat_timer: ReturnType<typeof setInterval> | undefined;

  constructor(
    private readonly settings: LinkSettings,
    private readonly listener: LinkListener,
  ) {}

  get current_state(): State {
    return this.state;
  }
  get session_id(): string {
    return this.session;
  }

  /** Begins to connect. Call once. */
  start(): void {
    this.open();
  }

  /** Makes a request and sends it as soon as the link is open. */
  ask<T>(
    operation: Operation,
    attributes: Record<string, string | number | boolean | undefined>,
    content: () => string,
    how: AskOptions<T>,
  ): Promise<T> {
    const request_id = `r${this.next_id++}`;
    return this.call(() => request(operation, { ...attributes, request_id }, content()), request_id, how);
  }

  /** Retries at once if a retry is scheduled. */
  retry(): void {
    if (this.socket || !this.attempt_timer || this.state === 'closed') return;
    clearTimeout(this.attempt_timer);
    this.open();
  }

  /** Sends a document unchanged and returns the answer. */
  send(text: string, deadline?: number): Promise<XmlElement> {
    return this.call(() => text, undefined, { deadline, repeatable: false, read: (answer) => answer });
  }

  /**
   * Ends the session and the link. If the link is lost, waits up to `deadline` ms for it, so that the engine stops what runs; then
   * leaves the session to expire.
   */
  close(deadline: number): Promise<void> {
    this.closing ??= this.disconnect(deadline);
    return this.closing;
  }

  private async disconnect(deadline: number): Promise<void> {
    const error = new RoisError('closed', 'the client was closed');
    for (const call of this.queue.splice(0)) call.failed(error);
    if (this.state !== 'closed' && this.session !== '')
      await this.ask('disconnect', {}, () => '', { deadline, repeatable: true, read: () => undefined }).catch(() => undefined);
    this.finish(error);
  }

  /** Ends the link at once with this error. */
  finish(error: RoisError): void {
    if (this.state === 'closed') return;
    this.stop_timers();
    this.socket?.close();
    this.socket = undefined;
    this.session = '';
    this.fail_all(error);
    this.set_state('closed', error.message);
    this.listener.session_ended(error);
  }

  // --- Calls ---

  private call<T>(make: () => string, request_id: string | undefined, how: AskOptions<T>): Promise<T> {
    return new Promise<T>((resolve, reject) => {
      if (this.state === 'closed') throw new RoisError('closed', 'the client was closed');
      const deadline = how.deadline ?? this.settings.deadline;
      const settle = () => {
        clearTimeout(timer);
        call.settled = true;
      };
      const call: Call = {
        text: written(make),
        request_id,
        repeatable: how.repeatable,
        sent_at: 0,
        settled: false,
        answered: (answer) => {
          settle();
          try {
            resolve(how.read(answer));
          } catch (error) {
            reject(error);
          }
        },
        failed: (error) => {
          settle();
          reject(error);
        },
      };
      const timer = setTimeout(() => {
        this.queue = this.queue.filter((one) => one !== call);
        call.failed(new RoisError('deadline', `no answer within ${how.of ?? deadline} ms${this.reason && `: ${this.reason}`}`));
      }, for_timer(deadline));
      if (this.ready) this.transmit(call);
      else this.queue.push(call);
    });
  }

  // Sends a request of the link itself, at once. If it fails, the link fails.
  private greet(
    operation: Operation,
    attributes: Record<string, string | number | boolean | undefined>,
    answered: (answer: XmlElement) => void,
  ): void {
    const request_id = `r${this.next_id++}`;
    const text = request(operation, { ...attributes, request_id });
    this.transmit({ text, request_id, repeatable: false, sent_at: 0, settled: false, answered, failed: () => undefined });
  }

  private transmit(call: Call): void {
    call.sent_at = this.last_sent_at = performance.now();
    if (/[<:](bind|execute)/.test(call.text)) this.may_move = true;
    this.in_flight.push(call);
    this.listener.document('out', call.text);
    this.socket?.send(call.text);
  }

  private flush(): void {
    for (const call of this.queue.splice(0)) this.transmit(call);
  }

  private fail_all(error: RoisError): void {
    for (const call of [...this.in_flight, ...this.queue.splice(0)]) call.failed(error);
  }

  // --- The link ---

  private open(): void {
    const { url, token, open_socket } = this.settings;
    this.attempt_timer = setTimeout(() => this.drop(`no session within ${open_within} ms`), open_within);
    try {
      this.socket = open_socket(url, subprotocols_with(token), {
        opened: () => this.opened(),
        received: (text) => this.received(text),
        ended: (end) => this.ended(end),
      });
    } catch (error) {
      this.ended({ reason: String(error), final: true });
    }
  }

  private opened(): void {
    if (this.session === '') this.begin_session();
    else this.resume_session();
  }

  // A browser answers pings even while the page hangs: only requests prove that the page is alive.
  private connect(answered: (answer: XmlElement) => void): void {
    const { motion_lease, open_socket, switches } = this.settings;
    const motion_proof = open_socket.answers_pings_alone ? 'request' : undefined;
    this.greet('connect', { motion_lease, motion_proof, switches }, answered);
  }

  private begin_session(): void {
    this.connect((answer) => {
      const trouble = trouble_of(answer);
      if (trouble?.failure === 'refused') this.finish(new RoisError('unreachable', trouble.message));
      else if (trouble) this.drop(trouble.message);
      else this.begun(answer.text_of('session'));
    });
  }

  private begun(session: string): void {
    this.session = session;
    this.last_sequence = 0;
    this.may_move = false;
    this.live('open', () => this.listener.session_began());
  }

  private resume_session(): void {
    this.greet('resume', { session: this.session, last_sequence: this.last_sequence }, (answer) => {
      const trouble = trouble_of(answer);
      if (!trouble) {
        this.live('resumed', () => undefined);
      } else if (trouble.failure === 'refused' || trouble.fault?.code === 'no_session') {
        this.lose_session(trouble.message, () => this.begin_session());
      } else {
        this.drop(trouble.message);
      }
    });
  }

  private live(state: State, first: () => void): void {
    clearTimeout(this.attempt_timer);
    clearInterval(this.heartbeat_timer);
    const { heartbeat, motion_lease = usual_lease, open_socket } = this.settings;
    const often = open_socket.answers_pings_alone ? motion_lease / 4 : heartbeat / 2;
    this.heartbeat_timer = setInterval(() => this.beat(often / 2), for_timer(Math.min(often, heartbeat / 2)));
    this.proving = false;
    this.ready = true;
    this.tries = 0;
    first();
    this.flush();
    this.set_state(state, '');
  }

  // Calls `then` unless a listener closed the client because of the loss.
  private lose_session(reason: string, then: () => void): void {
    const error = new RoisError('session_lost', `the session was lost: ${reason}`);
    this.session = '';
    this.ready = false;
    this.fail_all(error);
    this.listener.session_ended(error);
    this.listener.missed({ reason: 'session' });
    if (!this.closing) then();
  }

  // Pings when a ping is due: as a sign of life after `quiet` ms without a request, or to check a silent gateway.
  private beat(quiet: number): void {
    const now = performance.now();
    const oldest = this.in_flight[0];
    if (oldest && now - Math.max(this.last_received_at, oldest.sent_at) >= this.settings.heartbeat)
      this.drop(`the gateway has not answered for ${this.settings.heartbeat} ms`);
    else if (!oldest && now - this.last_received_at >= this.settings.heartbeat) this.ping();
    else if (this.settings.open_socket.answers_pings_alone && this.may_move && !this.proving && now - this.last_sent_at >= quiet)
      this.ping();
  }

  // In a live session, `connect` changes nothing (decision 1 of the gateway).
  private ping(): void {
    this.proving = true;
    this.connect((answer) => {
      this.proving = false;
      const trouble = trouble_of(answer);
      if (trouble) return this.drop(trouble.message);
      const session = answer.text_of('session');
      if (session !== this.session) this.lose_session('the engine has ended it', () => this.begun(session));
    });
  }

  private drop(reason: string): void {
    this.socket?.close();
    this.ended({ reason, final: false });
  }

  private ended({ reason, final, code }: SocketEnd): void {
    this.stop_timers();
    this.socket = undefined;
    // 1009: the gateway would reject the message again. 1007: only the first unanswered message can be the one.
    const most = code === 1009 && largest(this.in_flight);
    if (most) most.failed(rejected_by_gateway('too_large', `${reason}; this has ${bytes(most)} bytes`));
    if (code === 1007) this.in_flight[0]?.failed(rejected_by_gateway('not_well_formed', reason));
    for (const call of this.in_flight.splice(0)) {
      if (call.settled) continue;
      if (call.repeatable) this.queue.push(call); // empty while calls are in flight
      else call.failed(new RoisError('link_lost', `the link broke before the answer: ${reason}`));
    }
    if (final && this.state === 'connecting') {
      this.finish(new RoisError('unreachable', reason));
      return;
    }
    const delay = Math.min(this.settings.most_delay, this.settings.first_delay * 2 ** Math.min(this.tries++, 30));
    this.attempt_timer = setTimeout(() => this.open(), for_timer(delay * (1 - this.settings.random() / 2)));
    this.set_state(this.state === 'connecting' ? 'connecting' : 'lost', reason);
  }

  private stop_timers(): void {
    clearTimeout(this.attempt_timer);
    clearInterval(this.heartbeat_timer);
    this.ready = false;
  }

  private set_state(state: State, reason: string): void {
    this.state = state;
    this.reason = reason;
    this.listener.state_changed(state, reason);
  }

  // --- Received documents ---

  private received(text: string): void {
    this.last_received_at = performance.now();
    this.listener.document('in', text);
    if (this.state === 'closed') return; // by the document listener
    try {
      const document = parse_xml(text);
      if (is_notification(document)) this.notify(notification_of(document));
      else this.answer(document);
    } catch (error) {
      if (error instanceof XmlError || (error instanceof RoisError && error.failure === 'protocol')) this.drop(error.message);
      else throw error;
    }
  }

  private notify(notification: Notification): void {
    const { sequence } = notification;
    const first = this.last_sequence + 1;
    if (sequence < first) return; // already reported
    this.last_sequence = sequence;
    const count = notification.name === 'lost' ? notification.count : sequence - first;
    if (count > 0) this.listener.missed({ reason: 'lost', count, first, last: notification.name === 'lost' ? sequence : sequence - 1 });
    this.listener.notified(notification);
  }

  private answer(document: XmlElement): void {
    const [call] = this.in_flight;
    const echoed = document.attribute('request_id');
    if (call === undefined || (echoed !== undefined && call.request_id !== undefined && echoed !== call.request_id))
      throw new RoisError('protocol', `the gateway sent an answer without a request: ${document.name} ${document.text_of('reason')}`);
    const no_session = document.name === 'fault' && document.attribute('code') === 'no_session';
    if (no_session && this.ready && !this.closing) {
      this.lose_session('the engine has ended it', () => {
        this.in_flight.shift(); // lose_session has failed it
        this.begin_session();
      });
      return;
    }
    this.in_flight.shift();
    if (!call.settled) call.answered(document);
    if (document.name === 'disconnect_response' && !this.closing) this.finish(new RoisError('closed', 'the session was disconnected'));
  }
}

function bytes({ text }: Call): number {
  return new TextEncoder().encode(text).length;
}

function largest(calls: Call[]): Call | undefined {
  return calls.reduce<Call | undefined>((most, one) => (most && bytes(most) >= bytes(one) ? most : one), undefined);
}

function rejected_by_gateway(code: string, reason: string): RoisError {
  return new RoisError('fault', `${code}: ${reason}`, { fault: { code, reason } });
}

function written(make: () => string): string {
  try {
    return make();
  } catch (error) {
    if (error instanceof XmlError) throw new RoisError('invalid', error.message, { cause: error });
    throw error;
  }
}
