// A fake world for the state: the test moves the clock and scripts the engine.
import { namespaces, type OpenSocket, parse_xml, type SocketListener, type XmlElement } from 'rois-client';

import type { Environment, Stop } from '../../src/state/base/environment';
import { Console } from '../../src/state/console';

interface Alarm {
  at: number;
  every: number; // ms; 0: once
  act: () => void;
}

export class World implements Environment {
  origin = 'https://engine.example';
  readonly remembered = new Map<string, string>();
  /** Responses of GET, by path. */
  readonly pages = new Map<string, { status: number; text: string }>();
  /** Answers by operation. Given the request, each returns the answer's content or a whole document. */
  readonly answers = new Map<string, (request: XmlElement) => string>();
  /** Reasons of refusals, by operation. */
  readonly reasons = new Map<string, string>();
  /** Received requests, in order. */
  readonly requests: XmlElement[] = [];
  private time = Date.UTC(2026, 10, 20, 12);
  private alarms = new Set<Alarm>();
  private before: (() => void)[] = [];
  private listener: SocketListener | undefined;
  private sequence = 0;
  private sessions = 0;
  private tried = () => {};

  constructor() {
    this.answers.set('connect', () => `<session>session-${(this.sessions += 1)}</session>`);
    this.answers.set('resume', () => '');
  }

  // --- Environment ---

  now(): number {
    return this.time;
  }
  precise(): number {
    return this.time;
  }
  every(ms: number, act: () => void): Stop {
    return this.alarm({ at: this.time + ms, every: ms, act });
  }
  after(ms: number, act: () => void): Stop {
    return this.alarm({ at: this.time + ms, every: 0, act });
  }
  before_frame(act: () => void): void {
    this.before.push(act);
  }
  fetch(path: string): Promise<Response> {
    const page = this.pages.get(path);
    return page ? Promise.resolve(new Response(page.text, { status: page.status })) : Promise.reject(new Error('nobody there'));
  }
  recall(name: string): string | undefined {
    return this.remembered.get(name);
  }
  remember(name: string, value: string): void {
    this.remembered.set(name, value);
  }
  readonly open_socket: OpenSocket = (_url, _subprotocols, listener) => {
    this.listener = listener;
    this.tried();
    return { send: (text) => this.asked(text), close: () => (this.listener = undefined) };
  };

  // --- For tests ---

  /** A connected console. */
  async console(): Promise<Console> {
    const made = new Console(this);
    made.connect();
    await this.opens();
    return made;
  }

  /** Opens the socket that the client waits for. */
  async opens(): Promise<void> {
    this.listener!.opened();
    await settled();
  }

  /** Breaks the link. */
  breaks(reason = 'the WebSocket was closed with 1006'): void {
    this.listener!.ended({ reason, final: false });
  }

  /** Waits for the next attempt to connect. */
  tries_again(): Promise<void> {
    return new Promise((resolve) => (this.tried = resolve));
  }

  /** Sends a notification with the next sequence number. */
  async notifies(name: string, content = '', attributes = ''): Promise<void> {
    this.sequence += 1;
    this.says(`<${name} xmlns="${namespaces.message}" xmlns:rois="${namespaces.rois}" sequence="${this.sequence}" ${attributes}>${content}</${name}>`);
    await settled();
  }

  says(text: string): void {
    this.listener!.received(text);
  }

  /** Advances the time and fires due timers. */
  async passes(ms: number): Promise<void> {
    const end = this.time + ms;
    for (;;) {
      const next = [...this.alarms].filter((one) => one.at <= end).sort((a, b) => a.at - b.at)[0];
      if (!next) break;
      this.time = next.at;
      if (next.every > 0) next.at += next.every;
      else this.alarms.delete(next);
      next.act();
      await settled();
    }
    this.time = end;
  }

  /** Draws the next frame. */
  draws(): void {
    for (const act of this.before.splice(0)) act();
  }

  names(): string[] {
    return this.requests.map((one) => one.name);
  }

  private alarm(alarm: Alarm): Stop {
    this.alarms.add(alarm);
    return () => this.alarms.delete(alarm);
  }

  private asked(text: string): void {
    const listener = this.listener;
    const request = parse_xml(text);
    this.requests.push(request);
    const id = request.attribute('request_id');
    const content = this.answers.get(request.name)?.(request) ?? '';
    const echoed = id === undefined ? '' : ` request_id="${id}"`;
    const [code, inside] = /^[A-Z_]+$/.test(content) ? [content, `<reason>${this.reasons.get(request.name) ?? 'so it is'}</reason>`] : ['OK', content];
    const whole = `<${request.name}_response xmlns="${namespaces.message}" xmlns:rois="${namespaces.rois}" xmlns:gml="${namespaces.gml}" xmlns:xsi="${namespaces.xsi}" return_code="${code}"${echoed}>${inside}</${request.name}_response>`;
    queueMicrotask(() => listener?.received(whole));
  }
}

/** Lets all pending promises run. */
export async function settled(): Promise<void> {
  await new Promise((resolve) => setImmediate(resolve));
}

/** The children of get_profile's answer: components by their refs, with a profile each. */
export function profile_xml(components: Record<string, { type?: string; engine?: string; messages?: string; parameters?: string; includes?: string[] }>, engine = 'hall'): string {
  const urn = (name: string) => `urn:x-rois:def:component:OMG::${name}`;
  const entries = Object.entries(components);
  const listed = entries.map(([ref, one]) => `<component ref="${ref}" type="${urn(one.type ?? ref)}" engine="${one.engine ?? engine}"/>`).join('');
  const refs = entries.map(([ref]) => `<rois:HRIComponent>${ref}</rois:HRIComponent>`).join('');
  const profiles = entries.map(
    ([ref, one]) =>
      `<rois:HRIComponentProfile gml:id="profile.${ref}"><gml:identifier>${urn(one.type ?? ref)}</gml:identifier><gml:name>${ref}</gml:name>` +
      `${(one.includes ?? ['RoISCommon']).map((name) => `<rois:SubComponentProfile>${urn(name)}</rois:SubComponentProfile>`).join('')}` +
      `${one.messages ?? ''}${one.parameters ?? ''}</rois:HRIComponentProfile>`,
  );
  return (
    `<rois:HRIEngineProfile gml:id="engine.${engine}"><gml:identifier>urn:e</gml:identifier><gml:name>${engine}</gml:name>${refs}</rois:HRIEngineProfile>` +
    `<components>${listed}</components>${profiles.join('')}`
  );
}
