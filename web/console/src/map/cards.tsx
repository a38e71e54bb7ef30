// Cards of a target, person or robot with the actions for it.
import { useSignal } from '@preact/signals';
import type { ComponentChildren } from 'preact';
import { command } from 'rois-client';

import { useConsole } from '../context';
import { asked_by, parameters_from } from '../forms';
import { show_component } from '../shell/navigation';
import { distance, obstacle_at, turned } from '../state/floor/floor';
import { Button, error_text, Fact, Form, IconButton, SelectField, TextField } from '../ui';
import { type Driver, follow, go, motions_of, stop, target_text } from './driving';
import type { Target } from './interaction';
import { acts_text, age, certainty, degrees, metres, position } from './formats';
import type { Shown } from './scene';
import { session_of } from './session';
import * as texts from './texts';
import { PlaceChoice } from './toolbar';

const no_radius = 250; // mm

/** Runs an action and shows its error beside the button. */
function useAction(): { run(action: () => Promise<void>): void; is_busy: boolean; trouble: ComponentChildren } {
  const is_busy = useSignal(false);
  const trouble = useSignal('');
  return {
    run: (action) => {
      is_busy.value = true;
      trouble.value = '';
      action()
        .catch((error: unknown) => (trouble.value = error_text(error)))
        .finally(() => (is_busy.value = false));
    },
    is_busy: is_busy.value,
    trouble: trouble.value !== '' && <p class="map-trouble" role="alert">{trouble.value}</p>,
  };
}

function Card({ title, close, children }: { title: string; close: () => void; children: ComponentChildren }) {
  return (
    <section class="map-card" aria-label={title}>
      <header class="map-card-head">
        <h3>{title}</h3>
        <IconButton small icon="close" label={texts.close()} onClick={close} />
      </header>
      {children}
    </section>
  );
}

/** Chooses the robot to send, if there are several. */
function DriverChoice() {
  const session = session_of(useConsole());
  const all = session.drivers();
  if (all.length < 2) return null;
  const choices = all.map((one) => ({ value: one.engine, label: one.name }));
  return (
    <SelectField
      label={texts.robot()}
      value={session.driver()?.engine ?? ''}
      choices={choices}
      change={(engine) => (session.engine.value = engine)}
    />
  );
}

export interface Sending {
  is_busy: boolean;
  trouble: ComponentChildren;
  /** Undefined if it cannot be sent now. */
  send: (() => void) | undefined;
}

/** Sends the chosen robot to the target. */
export function useSending(): Sending {
  const console = useConsole();
  const session = session_of(console);
  const action = useAction();
  const driver = session.driver();
  const { target } = session.interaction.value;
  const limit = seconds_of(session.time_limit.value);
  const can = driver?.navigation !== undefined && target !== undefined && console.link.is_open && limit !== undefined && !action.is_busy;
  const send = () =>
    action.run(async () => {
      await go(console, driver!, target!, limit! * 1000);
      if (session.interaction.value.target === target) session.interaction.value = { ...session.interaction.value, target: undefined };
    });
  return { ...action, send: can ? send : undefined };
}

function seconds_of(text: string): number | undefined {
  const seconds = text.trim() === '' ? 0 : Number(text);
  return Number.isFinite(seconds) && seconds >= 0 ? seconds : undefined;
}

export function TargetCard({ target, sending }: { target: Target; sending: Sending }) {
  const console = useConsole();
  const session = session_of(console);
  const driver = session.driver();
  const map = session.map;
  const put = (to: Target | undefined) => (session.interaction.value = { ...session.interaction.value, target: to });
  const radius = map?.robots.find((one) => one.name === driver?.robot?.ref)?.radius ?? no_radius;
  const robot = session.scene().shown.find((one) => one.key === `robot ${driver?.robot?.ref}`);
  const blocked = target.place === undefined ? obstacle_at(map, target, radius) : undefined;
  const limit = seconds_of(session.time_limit.value);
  const places = [{ value: '', label: texts.point() }, ...(map?.places ?? []).map(({ name }) => ({ value: name, label: name }))];
  const choose = (name: string) => {
    const place = map?.places.find((one) => one.name === name);
    put(
      place
        ? { x: place.x, y: place.y, th: place.heading, place: name }
        : { x: target.x, y: target.y, ...(target.th !== undefined && { th: target.th }) },
    );
  };
  if (!driver?.navigation)
    return (
      <Card title={position(target)} close={() => put(undefined)}>
        <p>{texts.no_navigation()}</p>
      </Card>
    );
  return (
    <Card title={texts.send_title(driver.name)} close={() => put(undefined)}>
      <Form class="map-form" submit={sending.send}>
        <DriverChoice />
        {places.length > 1 && <SelectField label={texts.place()} value={target.place ?? ''} choices={places} change={choose} />}
        <div class="map-pose">
          <NumberField
            label="x"
            unit="m"
            text={(target.x / 1000).toFixed(2)}
            put={(x) => x !== undefined && put(moved(target, { x: Math.round(x * 1000) }))}
          />
          <NumberField
            label="y"
            unit="m"
            text={(target.y / 1000).toFixed(2)}
            put={(y) => y !== undefined && put(moved(target, { y: Math.round(y * 1000) }))}
          />
          <NumberField
            label={texts.direction()}
            unit="°"
            text={target.th === undefined ? '' : String(target.th)}
            hint={target.th === undefined ? texts.as_it_arrives() : texts.turn_hint()}
            put={(th) => put(th === undefined ? { x: target.x, y: target.y } : { x: target.x, y: target.y, th: Math.round(turned(th)) })}
          />
        </div>
        {target.th === undefined && <p class="field-hint">{texts.turn_hint()}</p>}
        <TextField
          label={texts.give_up()}
          unit="s"
          value={session.time_limit.value}
          change={(to) => (session.time_limit.value = to)}
          error={limit === undefined ? texts.no_number() : undefined}
          input={{ inputMode: 'numeric', placeholder: texts.never() }}
        />
        <p class="map-fact">
          {robot && texts.straight(metres(distance(robot, target), 1))} <span>{texts.sent_as()} <code>{target_text(target)}</code></span>
        </p>
        {blocked && <p class="map-warning">{texts.blocked(blocked)}</p>}
        {sending.trouble}
        {!console.link.is_open && <p class="map-warning">{texts.unlinked()}</p>}
        <div class="map-actions">
          <Button type="submit" look="primary" icon="send" busy={sending.is_busy} disabled={!sending.send} title={texts.turn_hint()}>
            {texts.send()}
          </Button>
          <Button onClick={() => put(undefined)}>{texts.cancel()}</Button>
        </div>
      </Form>
    </Card>
  );
}

// A moved target is no longer the named place.
function moved({ x, y, th }: Target, to: Partial<Target>): Target {
  return { x, y, ...(th !== undefined && { th }), ...to };
}

/** A number of the target. Keeps the text while the user edits it; `undefined`: not being edited. */
function NumberField({
  label,
  unit,
  text,
  hint,
  put,
}: {
  label: string;
  unit: string;
  text: string;
  hint?: string;
  put: (n: number | undefined) => void;
}) {
  const draft = useSignal<string | undefined>(undefined);
  const change = (typed: string) => {
    draft.value = typed;
    const n = Number(typed);
    if (Number.isFinite(n)) put(typed.trim() === '' ? undefined : n);
  };
  const is_wrong = draft.value !== undefined && !Number.isFinite(Number(draft.value));
  return (
    <TextField
      label={label}
      unit={unit}
      value={draft.value ?? text}
      change={change}
      error={is_wrong ? texts.no_number() : undefined}
      input={{ inputMode: 'decimal', placeholder: '–', title: hint ?? '', onBlur: () => (draft.value = undefined) }}
    />
  );
}

export function ThingCard({ thing, close }: { thing: Shown; close: () => void }) {
  const console = useConsole();
  const session = session_of(console);
  const driver = session.driver();
  const own = session.drivers().find((one) => thing.kind === 'robot' && one.robot?.ref === thing.thing.ref);
  const { ellipse, identity, th } = thing;
  const others = own === undefined ? driver : undefined;
  return (
    <Card title={`${texts.kind(thing.kind)} ${thing.name}`} close={close}>
      <dl class="map-facts">
        {thing.kind === 'person' && <Fact name={texts.name()}>{identity ? texts.identified(thing.thing.ref) : texts.unidentified()}</Fact>}
        <Fact name={texts.state()}>
          {texts.freshness(thing.freshness, thing.kind, age(thing.age))}
          {/gone|unknown/.test(thing.freshness) && ` (${texts.ago(age(thing.age))})`}
        </Fact>
        <Fact name={texts.position()}>{position(thing)}</Fact>
        {th !== undefined && <Fact name={texts.direction()}>{degrees(th)}</Fact>}
        <Fact name={texts.certainty()}>{ellipse ? certainty(ellipse) : texts.uncertain()}</Fact>
        <Fact name={texts.reported_by()}><ComponentLink component={thing.thing.component} /></Fact>
        {acts_text(thing) !== '' && <Fact name={texts.acts_for()}>{acts_text(thing)}</Fact>}
        {thing.frame && <Fact name={texts.own_frame()}><code>{thing.frame.crs}</code></Fact>}
        {others?.robot && <Fact name={texts.distance()}>{texts.near(others.name, metres(distance(others.robot, thing), 1))}</Fact>}
      </dl>
      {own ? <OwnRobot driver={own} /> : others && thing.kind !== 'sound' && <Pursuit driver={others} thing={thing} close={close} />}
    </Card>
  );
}

// A link to the component.
function ComponentLink({ component }: { component: string }) {
  const console = useConsole();
  return (
    <button type="button" class="map-link" onClick={() => show_component(console, component)}>
      <code>{component}</code>
    </button>
  );
}

function OwnRobot({ driver }: { driver: Driver }) {
  const console = useConsole();
  const action = useAction();
  void console.commands.pulse.beat.value;
  const components = console.profile.components.value.filter((one) => one.engine === driver.engine && !one.type_name.startsWith('System'));
  const voice = components.find((one) => one.type_name === 'SpeechSynthesis')?.ref;
  return (
    <>
      {driver.navigation !== undefined && (
        <p class="map-fact">
          <PlaceChoice /> <span>{texts.or_point()}</span>
        </p>
      )}
      {voice !== undefined && <Speaking voice={voice} />}
      <details class="map-commands">
        <summary>{texts.commands()}</summary>
        <ul class="plain-list">{components.map(({ ref }) => <li key={ref}><ComponentLink component={ref} /></li>)}</ul>
      </details>
      {action.trouble}
      {motions_of(console, driver).length > 0 && (
        <div class="map-actions">
          <Button look="danger" icon="stop" busy={action.is_busy} onClick={() => action.run(() => stop(console, driver))}>
            {texts.stop_robot(driver.name)}
          </Button>
        </div>
      )}
    </>
  );
}

// Speaks a sentence at once.
function Speaking({ voice }: { voice: string }) {
  const console = useConsole();
  const action = useAction();
  const words = useSignal('');
  const say = async () => {
    // Optional parameters get their defaults: a bound component keeps the values of an earlier speech.
    const asked = asked_by(console.profile.component(voice)!, 'start');
    const inputs = Object.fromEntries(
      asked.map(({ name, default_value }) => [name, { texts: [name === 'speech_text' ? words.value.trim() : (default_value ?? '')] }]),
    );
    const { command_ids, ends } = await console.execute([{ ...command(voice, 'start'), arguments: parameters_from(asked, inputs) }], {
      give_back: true,
    });
    words.value = '';
    const [status] = await ends;
    if (status !== 'ERROR') return;
    const entry = console.commands.find(command_ids[0]!);
    throw new Error((entry && (await console.commands.fetch_results(entry))?.text('reason')) || status);
  };
  return (
    <Form class="map-form" submit={() => words.value.trim() !== '' && action.run(say)}>
      <TextField
        label={texts.speak()}
        value={words.value}
        change={(to) => (words.value = to)}
        input={{ enterkeyhint: 'send', placeholder: texts.speak_hint() }}
      />
      {action.trouble}
      <div class="map-actions">
        <Button
          type="submit"
          look="primary"
          icon="messages"
          busy={action.is_busy}
          disabled={!console.link.is_open || words.value.trim() === ''}
        >
          {texts.speak()}
        </Button>
      </div>
    </Form>
  );
}

function Pursuit({ driver, thing, close }: { driver: Driver; thing: Shown; close: () => void }) {
  const console = useConsole();
  const session = session_of(console);
  const action = useAction();
  const gap = Number(session.gap.value);
  const is_number = session.gap.value.trim() !== '' && Number.isFinite(gap) && gap > 0;
  const go_there = () =>
    (session.interaction.value = {
      ...session.interaction.value,
      chosen: undefined,
      target: { x: Math.round(thing.x), y: Math.round(thing.y), whom: thing.name },
    });
  // The map shows the motion with a button to stop it.
  const pursue = () =>
    is_number && driver.follow && action.run(() => follow(console, driver, thing, Math.round(gap * 1000)).then(close));
  return (
    <Form class="map-form" submit={pursue}>
      <DriverChoice />
      {driver.follow ? (
        <TextField
          label={texts.gap()}
          unit="m"
          value={session.gap.value}
          change={(to) => (session.gap.value = to)}
          error={is_number ? undefined : texts.no_gap()}
          input={{ inputMode: 'decimal' }}
        />
      ) : (
        <p>{texts.no_follow()}</p>
      )}
      {action.trouble}
      <div class="map-actions">
        {driver.follow && (
          <Button
            type="submit"
            look="primary"
            icon="person"
            busy={action.is_busy}
            disabled={!console.link.is_open || !is_number}
            title={texts.follow_whom(thing.name)}
          >
            {texts.follow()}
          </Button>
        )}
        {driver.navigation && <Button icon="send" onClick={go_there}>{texts.go_there()}</Button>}
        {driver.navigation && driver.follow && <p class="field-hint">{texts.follow_or_go()}</p>}
      </div>
    </Form>
  );
}
