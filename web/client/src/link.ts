// The link to the gateway: a session over one WebSocket after another. It connects, finds out that a link is dead, opens a new one,
// resumes the session, sends again what was not answered and may be repeated, and hands on each notification once.
import { is_notification, notification_of, trouble_of } from './answers.js';
import { RoisError } from './errors.js';
import type { Gap, Notification } from './messages.js';
import { type Operation, request } from './requests.js';
import { type OpenSocket, type Socket, type SocketEnd, subprotocols_with } from './socket.js';
import { for_timer } from './times.js';
import { parse_xml, type XmlElement, XmlError } from './xml.js';

/**
 * How the link is:
 * - `connecting`: for the first time; calls wait;
 * - `open`: with a new session;
 * - `lost`: the link broke; a new one is tried for, calls wait;
 * - `resumed`: open again with the session as it was; what was missed is told;
 * - `closed`: for good.
 */
export type State = 'connecting' | 'open' | 'lost' | 'resumed' | 'closed';

export interface LinkSettings {
  url: string; // ws: or wss:
  token?: string;
  deadline: number; // ms that a call takes at most, unless it says otherwise
  heartbeat: number; // ms of silence after which the gateway is asked whether it lives; the link is given up after as many again
  first_delay: number; // ms before the first new try after a loss; doubled with each further one
  most_delay: number; // ms
  random: () => number; // 0 to 1: each delay is cut by up to a half, so that many clients do not come at once
  motion_lease?: number; // ms that a robot goes on without a sign of life: less than the gateway's
  open_socket: OpenSocket;
}

export interface LinkListener {
  state_changed(state: State, reason: string): void;
  /** A new session is there; what the application wants of every session may be asked for first. */
  session_began(): void;
  /** The session is lost with all that it had; every call that waited has failed. */
  session_ended(error: RoisError): void;
  notified(notification: Notification): void;
  missed(gap: Gap): void;
  document(direction: 'in' | 'out', text: string): void;
}

/** How a call is made. */
export interface Asking<T> {
  deadline?: number | undefined; // ms
  /** What the caller is told in the end that there was no answer within: `deadline`, unless that is the rest of a longer one. */
  of?: number | undefined; // ms
  /** Sent again on a new link when the old one broke before the answer; else it fails with `link_lost`. */
  repeatable: boolean;
  /** Makes the result of an answer, before anything that came after it is looked at. */
  read(answer: XmlElement): T;
}

interface Call {
  text: string;
  request_id: string | undefined;
  repeatable: boolean;
  sent_at: number;
  settled: boolean; // nobody waits for the answer any more
  answered(answer: XmlElement): void;
  failed(error: RoisError): void;
}

const usual_lease = 2000; // ms, of a gateway that was not told otherwise
const open_within = 10_000; // ms for a link to be opened and greeted

export class Link {
  private state: State = 'connecting';
  private reason = ''; // why the link is not open
  private session = '';
  private last_sequence = 0; // of the session
  private socket: Socket | undefined;
  private ready = false; // the session is there and calls may be sent
  private queue: Call[] = []; // to be sent
  private in_flight: Call[] = []; // sent, in order, without their answers
  private heard_at = 0;
  private said_at = 0;
  private may_move = false; // something was bound in this session, or executed
  private proving = false; // a sign of life is on its way
  private tries = 0; // that have failed since a link had a session
  private next_id = 1;
  private closing: Promise<void> | undefined;
  private patience: ReturnType<typeof setTimeout> | undefined; // until the next try, or until one has failed
  private heart: ReturnType<typeof setInterval> | undefined;

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

  /** Begins to connect. Once. */
  start(): void {
    this.open();
  }

  /** Makes a request and sends it as soon as there is a link. */
  ask<T>(operation: Operation, attributes: Record<string, string | number | boolean | undefined>, content: () => string, how: Asking<T>): Promise<T> {
    const request_id = `r${this.next_id++}`;
    return this.call(() => request(operation, { ...attributes, request_id }, content()), request_id, how);
  }

  /** While it waits before the next try to open a link: tries at once. */
  retry(): void {
    if (this.socket || !this.patience || this.state === 'closed') return;
    clearTimeout(this.patience);
    this.open();
  }

  /** Sends a document as it is; gives the answer, whatever it says. */
  send(text: string, deadline?: number): Promise<XmlElement> {
    return this.call(() => text, undefined, { deadline, repeatable: false, read: (answer) => answer });
  }

  /**
   * Ends the session and the link. When the link is lost just now it is waited for, so that the engine stops what runs; after `deadline` ms
   * the session is left to its end.
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

  /** Ends the link at once, for this reason. */
  finish(error: RoisError): void {
    if (this.state === 'closed') return;
    this.quieten();
    this.socket?.close();
    this.socket = undefined;
    this.session = '';
    this.fail_all(error);
    this.turn('closed', error.message);
    this.listener.session_ended(error);
  }

  // --- Calls ---

  private call<T>(make: () => string, request_id: string | undefined, how: Asking<T>): Promise<T> {
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

  // A call of the link's own, sent at once; what goes wrong with it goes wrong with the link.
  private greet(operation: Operation, attributes: Record<string, string | number | undefined>, answered: (answer: XmlElement) => void): void {
    const request_id = `r${this.next_id++}`;
    const text = request(operation, { ...attributes, request_id });
    this.transmit({ text, request_id, repeatable: false, sent_at: 0, settled: false, answered, failed: () => undefined });
  }

  private transmit(call: Call): void {
    call.sent_at = this.said_at = performance.now();
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
    this.patience = setTimeout(() => this.drop(`no session within ${open_within} ms`), open_within);
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

  // A browser answers pings by itself, also while the page hangs: only requests are proof that the page lives.
  private connect(answered: (answer: XmlElement) => void): void {
    const { motion_lease, open_socket } = this.settings;
    this.greet('connect', { motion_lease, motion_proof: open_socket.answers_pings_alone ? 'request' : undefined }, answered);
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
    clearTimeout(this.patience);
    clearInterval(this.heart);
    const { heartbeat, motion_lease = usual_lease, open_socket } = this.settings;
    const often = open_socket.answers_pings_alone ? motion_lease / 4 : heartbeat / 2;
    this.heart = setInterval(() => this.beat(often / 2), for_timer(Math.min(often, heartbeat / 2)));
    this.proving = false;
    this.ready = true;
    this.tries = 0;
    first();
    this.flush();
    this.turn(state, '');
  }

  // What comes then does not, when whoever hears of the loss closes the client.
  private lose_session(reason: string, then: () => void): void {
    const error = new RoisError('session_lost', `the session was lost: ${reason}`);
    this.session = '';
    this.ready = false;
    this.fail_all(error);
    this.listener.session_ended(error);
    this.listener.missed({ reason: 'session' });
    if (!this.closing) then();
  }

  // What is due: a sign of life when nothing was said for as long as this, or a look whether the gateway lives.
  private beat(quiet: number): void {
    const now = performance.now();
    const oldest = this.in_flight[0];
    if (oldest && now - Math.max(this.heard_at, oldest.sent_at) >= this.settings.heartbeat)
      this.drop(`the gateway has not answered for ${this.settings.heartbeat} ms`);
    else if (!oldest && now - this.heard_at >= this.settings.heartbeat) this.ping();
    else if (this.settings.open_socket.answers_pings_alone && this.may_move && !this.proving && now - this.said_at >= quiet) this.ping();
  }

  // `connect` changes nothing in a session that lives (decision 1 of the gateway).
  private ping(): void {
    this.proving = true;
    this.connect((answer) => {
      this.proving = false;
      const trouble = trouble_of(answer);
      if (trouble) return this.drop(trouble.message);
      const session = answer.text_of('session');
      if (session !== this.session) this.lose_session('the engine had ended it', () => this.begun(session));
    });
  }

  private drop(reason: string): void {
    this.socket?.close();
    this.ended({ reason, final: false });
  }

  private ended({ reason, final, code }: SocketEnd): void {
    this.quieten();
    this.socket = undefined;
    // What the gateway would not read, it would not read again. Of what is no UTF-8 nothing is known but that it was the next one.
    const most = code === 1009 && largest(this.in_flight);
    if (most) most.failed(unread('too_large', `${reason}; this has ${bytes(most)} bytes`));
    if (code === 1007) this.in_flight[0]?.failed(unread('not_well_formed', reason));
    for (const call of this.in_flight.splice(0)) {
      if (call.settled) continue;
      if (call.repeatable) this.queue.push(call); // where nothing is while such calls are in flight
      else call.failed(new RoisError('link_lost', `the link broke before the answer: ${reason}`));
    }
    if (final && this.state === 'connecting') {
      this.finish(new RoisError('unreachable', reason));
      return;
    }
    const delay = Math.min(this.settings.most_delay, this.settings.first_delay * 2 ** Math.min(this.tries++, 30));
    this.patience = setTimeout(() => this.open(), for_timer(delay * (1 - this.settings.random() / 2)));
    this.turn(this.state === 'connecting' ? 'connecting' : 'lost', reason);
  }

  private quieten(): void {
    clearTimeout(this.patience);
    clearInterval(this.heart);
    this.ready = false;
  }

  private turn(state: State, reason: string): void {
    this.state = state;
    this.reason = reason;
    this.listener.state_changed(state, reason);
  }

  // --- What comes ---

  private received(text: string): void {
    this.heard_at = performance.now();
    this.listener.document('in', text);
    if (this.state === 'closed') return; // by whoever has heard it
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
    if (sequence < first) return; // told already
    this.last_sequence = sequence;
    const count = notification.name === 'lost' ? notification.count : sequence - first;
    if (count > 0) this.listener.missed({ reason: 'lost', count, first, last: notification.name === 'lost' ? sequence : sequence - 1 });
    this.listener.notified(notification);
  }

  private answer(document: XmlElement): void {
    const [call] = this.in_flight;
    const echoed = document.attribute('request_id');
    if (call === undefined || (echoed !== undefined && call.request_id !== undefined && echoed !== call.request_id))
      throw new RoisError('protocol', `the gateway says what nobody asked for: ${document.name} ${document.text_of('reason')}`);
    const no_session = document.name === 'fault' && document.attribute('code') === 'no_session';
    if (no_session && this.ready && !this.closing) {
      this.lose_session('the engine had ended it', () => {
        this.in_flight.shift(); // has failed with the others
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

function unread(code: string, reason: string): RoisError {
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
