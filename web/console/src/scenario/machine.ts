// Runs a scenario, as `rois scenario` does. docs/rois-command.md defines states, triggers and steps.
import {
  code_of,
  type Completed,
  type CompletedStatus,
  component_ref,
  type CommandMessage,
  type ReceiveEvent,
  Results,
  type Subscription,
} from 'rois-client';

import type { Stop } from '../state/base/environment';
import type { Console } from '../state/console';
import type { GiveBack } from '../state/session/bindings';
import { to_double } from './grammar';
import { Inbox } from './inbox';
import type { Scenario, ScenarioCommand, State, Trigger, TriggerKind } from './model';
import * as texts from './texts';
import { Trouble } from './trouble';
import { typed_arguments } from './typed';
import { listed, Variables } from './variables';

/** Receives the steps of a run. */
export interface Observer {
  entered(state: State): void;
  /** The commands of `leaving` are sent and have not ended. */
  leaving(state: State, trigger: Trigger): void;
  left(state: State, trigger: Trigger, by: string): void;
  printed(line: string): void;
  variables(variables: Variables): void;
}

/** How it ended: in an `end` state, in a state marked `failed`, stopped by the user, or with an error. */
export type Outcome = { how: 'ended' | 'failed'; state: string } | { how: 'stopped' } | { how: 'trouble'; trouble: unknown };

const most_in_a_row = 100; // states before the page gets time to respond: the scenario may loop

export class Machine {
  readonly variables: Variables;
  private readonly inbox: Inbox;
  private readonly refs = new Map<string, string>(); // by the scenario's names
  private readonly borrowed: GiveBack[] = [];
  private readonly subscriptions: Subscription[] = [];
  private state!: State;
  private next: string | undefined;
  private entered = 0;
  private pending: string[] = [];
  private status: CompletedStatus = 'OK';
  private readonly fired = new Set<Trigger>();

  constructor(
    private readonly console: Console,
    private readonly scenario: Scenario,
    private readonly observer: Observer,
  ) {
    this.variables = new Variables(scenario.variables);
    this.inbox = new Inbox(console.environment);
  }

  /** Ends the run and stops its commands. */
  stop(): void {
    this.inbox.end('stopped');
  }

  async run(): Promise<Outcome> {
    const stops = this.listen();
    try {
      await this.bind();
      await this.subscribe();
      this.next = this.scenario.start;
      for (let in_a_row = 0; this.next !== undefined || !this.state.is_end; ++in_a_row) {
        this.check();
        if (this.next === undefined) in_a_row = 0;
        if (in_a_row === most_in_a_row) {
          in_a_row = 0;
          await new Promise<void>((resolve) => this.console.environment.after(0, resolve));
        }
        if (this.next === undefined) await this.process_next();
        else await this.enter(this.scenario.states.get(this.next)!);
      }
      return { how: this.state.failed ? 'failed' : 'ended', state: this.state.name };
    } catch (trouble) {
      return this.inbox.ended === 'stopped' ? { how: 'stopped' } : { how: 'trouble', trouble };
    } finally {
      for (const stop of stops) stop();
      await this.let_go();
    }
  }

  private listen(): Stop[] {
    const { client } = this.console;
    return [
      client.on('notification', (notification) => this.inbox.put(notification)),
      client.on('gap', (gap) => gap.reason === 'session' && this.inbox.end('session')),
      client.on('state', ({ state }) => state === 'closed' && this.inbox.end('closed')),
    ];
  }

  private check(): void {
    switch (this.inbox.ended) {
      case 'stopped':
        return Trouble.raise(texts.stopped);
      case 'session':
        return Trouble.raise(texts.session_ended);
      case 'closed':
        return Trouble.raise(texts.connection_closed);
    }
  }

  private async bind(): Promise<void> {
    for (const { name, ref, type, switching } of this.scenario.components) {
      this.check();
      if (ref !== '') this.borrowed.push(await this.console.bindings.borrow([ref], switching));
      const any = ref === '' ? await this.console.bindings.borrow_any(type, switching) : undefined;
      if (any) this.borrowed.push(any.give_back);
      this.refs.set(name, any?.ref ?? ref);
    }
  }

  private async subscribe(): Promise<void> {
    const triggers = [...this.scenario.states.values()].flatMap((state) => state.triggers);
    for (const type of new Set(triggers.filter(({ kind }) => kind === 'event').map(({ event_type }) => event_type)))
      this.subscriptions.push(await this.console.subscribe(type));
  }

  // Returns all components bound for the run. Components that the user had bound before stay bound, but stop unless another part of this
  // page uses them.
  private async let_go(): Promise<void> {
    const { bindings } = this.console;
    const session_is_there = this.inbox.ended !== 'session' && this.inbox.ended !== 'closed';
    for (const give_back of this.borrowed.reverse()) await give_back();
    if (!session_is_there) return;
    const kept = [...this.refs.values()].filter((ref) => bindings.mine.value.has(ref) && bindings.lent(ref) === 0);
    await Promise.all([
      ...kept.map((ref) => this.console.run(ref, 'stop', {}, { give_back: true }).catch(() => undefined)),
      ...this.subscriptions.map((one) => one.close().catch(() => undefined)),
    ]);
  }

  private async enter(state: State): Promise<void> {
    this.next = undefined;
    this.state = state;
    this.pending = [];
    this.status = 'OK';
    this.observer.entered(state);
    this.publish(this.variables.take(state.steps, undefined) ?? []);
    this.inbox.clear(); // earlier events do not trigger in the new state
    this.entered = this.console.environment.now();
    this.pending = await this.execute(state.commands);
    if (state.query && (await this.fire('answered', await this.ask(state.query), 'answered'))) return;
    await this.fire('at_once', new Results(), 'at once');
  }

  private async execute(commands: readonly ScenarioCommand[]): Promise<string[]> {
    const units = commands.map((command): CommandMessage => {
      const ref = this.refs.get(command.component)!;
      const component = this.console.profile.component(ref) ?? Trouble.raise(() => texts.no_component(ref));
      const given = command.arguments.map(({ name, text }) => ({ name, text: this.variables.filled(text) }));
      const message: CommandMessage = {
        kind: 'command',
        component_ref: ref,
        command_type: command.type,
        command_id: '',
        arguments: typed_arguments(component, command.type, given),
      };
      return command.delay === undefined ? message : { ...message, delay_time: command.delay };
    });
    if (units.length === 0) return [];
    const { command_ids } = await this.console.client.execute(units);
    return [...command_ids];
  }

  private async ask({ type, component }: NonNullable<State['query']>): Promise<Results> {
    return (await this.console.query(type, component === '' ? undefined : component_ref(this.refs.get(component)!))).results;
  }

  private async process_next(): Promise<void> {
    const due = this.next_timer();
    const news = await this.inbox.take(due);
    this.check();
    if (news?.name === 'receive_event') await this.take_event(news);
    else if (news) await this.take_completed(news);
    else if (due !== undefined && this.console.environment.now() >= due) await this.fire_timers();
  }

  private async take_event(event: ReceiveEvent): Promise<void> {
    if (!this.subscriptions.some((one) => one.subscribe_id === event.subscribe_id)) return; // of another subscriber
    const is_meant = (trigger: Trigger) =>
      trigger.kind === 'event' &&
      trigger.event_type === event.event_type &&
      (trigger.component === '' || this.refs.get(trigger.component) === code_of(event.component_ref));
    await this.fire_if(is_meant, event.results, `${event.event_type} ${values_of(event.results)}`);
  }

  private async take_completed({ command_id, status }: Completed): Promise<void> {
    if (!this.pending.includes(command_id)) return;
    this.pending = this.pending.filter((one) => one !== command_id);
    if (this.status === 'OK') this.status = status;
    if (this.pending.length > 0) return;
    const ended = this.status;
    const is_meant = (trigger: Trigger) => trigger.kind === 'completed' && (trigger.status === undefined || trigger.status === ended);
    if (await this.fire_if(is_meant, undefined, `completed ${ended}`)) return;
    const { name, triggers } = this.state;
    if (!triggers.some(({ kind }) => kind === 'event' || kind === 'after')) Trouble.raise(() => texts.unexpected_end(name, ended));
  }

  // --- Timers, from the entry of the state ---

  private due(trigger: Trigger): number {
    const text = this.variables.filled(trigger.seconds);
    const seconds = to_double(text) ?? NaN;
    if (!(seconds >= 0 && seconds < 1e9)) Trouble.raise(() => texts.no_seconds(this.state.name, text));
    return this.entered + seconds * 1000;
  }

  private timers(): Trigger[] {
    return this.state.triggers.filter((one) => one.kind === 'after' && !this.fired.has(one));
  }

  private next_timer(): number | undefined {
    const times = this.timers().map((one) => this.due(one));
    return times.length === 0 ? undefined : Math.min(...times);
  }

  // Each fires once in a state, whether its conditions hold or not.
  private async fire_timers(): Promise<void> {
    const now = this.console.environment.now();
    for (const trigger of this.timers()) {
      if (this.due(trigger) > now) continue;
      this.fired.add(trigger);
      if (await this.fire_if((one) => one === trigger, undefined, `after ${this.variables.filled(trigger.seconds)} s`)) return;
    }
  }

  // --- Transitions ---

  private fire(kind: TriggerKind, results: Results, by: string): Promise<boolean> {
    return this.fire_if((trigger) => trigger.kind === kind, results, by);
  }

  // The first matching trigger whose conditions hold is taken.
  private async fire_if(is_meant: (trigger: Trigger) => boolean, results: Results | undefined, by: string): Promise<boolean> {
    for (const trigger of this.state.triggers) {
      const printed = is_meant(trigger) ? this.variables.take(trigger.steps, results) : undefined;
      if (!printed) continue;
      await this.leave(trigger, by, printed);
      return true;
    }
    return false;
  }

  private async leave(trigger: Trigger, by: string, printed: string[]): Promise<void> {
    const from = this.state;
    this.publish(printed);
    if (from.leaving.length > 0) this.observer.leaving(from, trigger);
    await this.wait_for_all(await this.execute(from.leaving));
    this.observer.left(from, trigger, by);
    this.fired.clear();
    this.next = trigger.to;
  }

  private async wait_for_all(ids: string[]): Promise<void> {
    while (ids.length > 0) {
      const news = await this.inbox.take();
      this.check();
      if (news?.name === 'completed') ids = ids.filter((one) => one !== news.command_id);
    }
  }

  private publish(printed: readonly string[]): void {
    for (const line of printed) this.observer.printed(line);
    this.observer.variables(this.variables);
  }
}

function values_of(results: Results): string {
  return results.parameters
    .filter(({ name }) => name !== 'timestamp')
    .map(({ name, values }) => `${name}=${listed(values)}`)
    .join(' ');
}
