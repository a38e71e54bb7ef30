// The cases of tests/scenarios, and the engine that plays their scripts. The README.md there describes the format.
import { readFileSync } from 'node:fs';

import type { XmlElement } from 'rois-client';
import { expect } from 'vitest';

import type { Desk } from '../../src/scenario/desk';
import { Trouble } from '../../src/scenario/trouble';
import { settled, World } from './world';

type Values = Record<string, string[]>;
type Step =
  | { execute: string[]; refused?: string }
  | { query: string; component?: string; results?: Values; refused?: string }
  | { event: string; component: string; results?: Values; subscription?: string }
  | { completed: string; command: number }
  | { error: string }
  | { session: 'ends' }
  | { wait: number } // s
  | { stop: true };
export interface Case {
  name: string;
  document?: string;
  states?: string;
  problem: string;
  script: Step[];
  history: string[];
  end: string;
  subscribed?: string[];
  bound?: string[];
}

const folder = new URL('../../../../tests/scenarios/', import.meta.url);
const text_of = (file: string) => readFileSync(new URL(file, folder), 'utf8');
const profile = /^<[^>]*>(.*)<\/get_profile_response>\s*$/s.exec(text_of('engine.xml'))![1]!;

export function cases_of(file: string): { name: string; one: Case; text: string }[] {
  const { document, cases } = JSON.parse(text_of(file)) as { document: string; cases: Case[] };
  return cases.map((one) => ({ name: one.name, one, text: one.document ?? document.replace('{states}', one.states!) }));
}

export const attribute_of = (element: XmlElement, name: string) => element.attributes.find((one) => one.name === name)?.value ?? '';
const has_text = (element: XmlElement, text: string): boolean => element.text.trim() === text || element.children.some((one) => has_text(one, text));

/** `move.start(line=1 2)`. */
export function written(unit: XmlElement): string {
  const given = (unit.child('arguments')?.children ?? []).map((one) => `${attribute_of(one, 'name')}=${one.all('value').map((value) => value.text).join('|')}`);
  const delay = attribute_of(unit, 'delay_time');
  return `${attribute_of(unit.child('component_ref')!, 'code')}.${attribute_of(unit, 'command_type')}(${given.join(', ')})${delay === '' ? '' : `+${delay}`}`;
}

function results_xml(results: Values = {}): string {
  const each = Object.entries(results).map(([name, values]) => `<result rois:name="${name}"><rois:data_type_ref rois:code="string[]"/>${values.map((one) => `<rois:value>${one}</rois:value>`).join('')}</result>`);
  return `<results>${each.join('')}</results>`;
}

/** A world with the engine of engine.xml. */
export function world_of_cases(): World {
  const world = new World();
  world.answers.set('get_profile', () => profile);
  world.answers.set('bind_any', () => '<component_ref rois:code="speech"/>');
  world.pages.set('/rois/map', { status: 404, text: '' });
  return world;
}

/** The answer to `execute`. */
export function echo_of(units: readonly XmlElement[]): string {
  const echo = units.map((one) => `<rois:command_unit_list xsi:type="rois:CommandMessageType" rois:command_type="${attribute_of(one, 'command_type')}" rois:command_id="${attribute_of(one, 'command_id')}"><rois:component_ref rois:code="${attribute_of(one.child('component_ref')!, 'code')}"/></rois:command_unit_list>`);
  return `<rois:CommandUnitSequence>${echo.join('')}</rois:CommandUnitSequence>`;
}

/** The units of a received `execute`. */
export function units_of(request: XmlElement): readonly XmlElement[] {
  return request.child('CommandUnitSequence')!.children;
}

/** The engine of a case. */
export class Engine {
  readonly world = world_of_cases();
  readonly subscriptions = new Map<string, string>(); // ids by event type
  private readonly commands: string[] = [];
  private readonly requests: Step[];
  private received = 0;

  constructor(script: readonly Step[]) {
    this.requests = script.filter((step) => 'execute' in step || 'query' in step);
    const { answers } = this.world;
    answers.set('subscribe', (request) => this.subscribe(request));
    answers.set('execute', (request) => this.execute(request));
    answers.set('query', (request) => this.query(request));
  }

  /** The bound components or their types in order, each with its `switching`. */
  get bound(): string[] {
    return this.world.requests
      .filter(({ name }) => name === 'bind' || name === 'bind_any')
      .map((one) => {
        const component = one.name === 'bind' ? attribute_of(one.child('component_ref')!, 'code') : 'SpeechSynthesis';
        return `${component} ${one.attribute('switching') ?? 'none'}`;
      });
  }

  /** Waits for the next request of the script. */
  async receives(count: number): Promise<void> {
    for (let i = 0; i < 40 && this.received < count; ++i) await settled();
    expect(this.received).toBeGreaterThanOrEqual(count);
  }

  async does(step: Step, desk: Desk): Promise<void> {
    const { world } = this;
    if ('event' in step) {
      const subscribe_id = step.subscription ?? this.subscriptions.get(step.event) ?? 'none';
      const component = `<component_ref rois:code="${step.component}"/>`;
      await world.notifies('receive_event', `<event_id>e</event_id><event_type>${step.event}</event_type><subscribe_id>${subscribe_id}</subscribe_id><expire>2026-11-20T12:01:00Z</expire>${component}${results_xml(step.results)}`);
    } else if ('completed' in step) {
      await world.notifies('completed', `<command_id>${this.commands[step.command]}</command_id><status>${step.completed}</status>`);
    } else if ('error' in step) {
      await world.notifies('receive_error', `<error_id>1</error_id><error_type>COMPONENT_INTERNAL_ERROR</error_type><component_ref rois:code="${step.error}"/>`);
    } else if ('wait' in step) {
      await world.passes(step.wait * 1000);
    } else if ('session' in step) {
      world.answers.set('resume', () => 'ERROR');
      world.breaks();
      await world.tries_again();
      await world.opens();
    } else if ('stop' in step) {
      desk.stop();
    }
  }

  private subscribe(request: XmlElement): string {
    const type = request.child('event_type')!.text;
    expect(this.subscriptions.has(type)).toBe(false);
    this.subscriptions.set(type, `s-${this.subscriptions.size + 1}`);
    return `<subscribe_id>${this.subscriptions.get(type)}</subscribe_id>`;
  }

  private execute(request: XmlElement): string {
    const units = units_of(request);
    const { execute, refused } = this.expected<{ execute: string[]; refused?: string }>({ execute: units.map(written) });
    expect(units.map(written)).toEqual(execute);
    this.commands.push(...units.map((one) => attribute_of(one, 'command_id')));
    if (refused !== undefined) return this.refuse('execute', refused);
    return echo_of(units);
  }

  private query(request: XmlElement): string {
    const type = request.child('query_type')!.text;
    const { query, component, results, refused } = this.expected<{ query: string; component?: string; results?: Values; refused?: string }>({ query: type });
    expect(type).toBe(query);
    expect(request.child('condition') !== undefined).toBe(component !== undefined);
    if (component !== undefined) expect(has_text(request, component)).toBe(true);
    return refused !== undefined ? this.refuse('query', refused) : `<component_ref rois:code="system"/>${results_xml(results)}`;
  }

  private expected<Request>(received: unknown): Request {
    const step = this.requests[this.received++];
    if (!step) throw new Error(`not in the script: ${JSON.stringify(received)}`);
    return step as Request;
  }

  private refuse(operation: string, reason: string): string {
    this.world.reasons.set(operation, reason);
    return 'ERROR';
  }
}

export function history_of(desk: Desk): string[] {
  return desk.history.list().map((entry) => (entry.kind === 'print' ? entry.line : `${entry.from} -> ${entry.to}  ${entry.by}`));
}

export function end_of(desk: Desk): string {
  const { outcome } = desk.run!;
  if (outcome?.how !== 'trouble') return outcome?.how ?? 'runs';
  return `error: ${outcome.trouble instanceof Trouble ? outcome.trouble.say() : String(outcome.trouble)}`;
}
