// Robots that this console can send, their motion components and current motions.
import { value } from 'rois-client';

import { show_document, show_panel } from '../shell/navigation';
import type { Console } from '../state/console';
import type { Robot } from '../state/floor/things';
import type { CommandEntry } from '../state/session/commands_state';
import type { Target } from './interaction';
import { target_words } from './formats';
import type { Shown } from './scene';
import * as texts from './texts';

/** A robot and the components of its engine that move it. */
export interface Driver {
  engine: string;
  name: string;
  robot: Robot | undefined; // undefined if its position is unknown
  navigation: string | undefined;
  follow: string | undefined;
  wheels: string[]; // all components that move it
}

const moving_types = ['Navigation', 'Follow', 'Move'];

export function drivers_of({ profile, robots }: Console): Driver[] {
  const movers = moving_types.map((type) => profile.of_type(type));
  const engines = new Set(movers.flatMap((components) => components.map((one) => one.engine)));
  return [...engines].map((engine): Driver => {
    const [navigation, follow, move] = movers.map((components) => components.find((one) => one.engine === engine)?.ref);
    const engine_robots = [...robots.all.values()].filter((one) => profile.component(one.component)?.engine === engine);
    const robot = engine_robots.find((one) => one.ref === engine) ?? engine_robots[0];
    const wheels = [navigation, follow, move].filter((one) => one !== undefined);
    return { engine, name: robot?.ref ?? engine, robot, navigation, follow, wheels };
  });
}

/** Its open `start` commands from this console, newest last. */
export function motions_of({ commands }: Pick<Console, 'commands'>, driver: Driver): CommandEntry[] {
  return commands.open().filter((one) => one.command_type === 'start' && driver.wheels.includes(one.component));
}

/** The target as navigation's text: the name of a place, `x, y`, or `x, y, th`. */
export function target_text({ x, y, th, place }: Target): string {
  return place ?? (th === undefined ? `${x}, ${y}` : `${x}, ${y}, ${th}`);
}

/** Sends the robot. `time_limit` in ms; 0: none. Rejects if the command is not accepted. */
export async function go(console: Console, driver: Driver, target: Target, time_limit: number): Promise<void> {
  const named = { target_position: value.strings([target_text(target)]), time_limit: value.int(time_limit) };
  const words = target_words(target);
  await drive(console, driver, driver.navigation!, named, words, texts.arrived(driver.name, words));
}

/** Makes the robot follow a person, by the permanent name if known. */
export async function follow(console: Console, driver: Driver, { thing, identity, name }: Shown, distance: number): Promise<void> {
  const { ref: code, codebook } = identity ?? thing;
  const person = value.identifier(codebook === '' ? code : { code, codebook_ref: codebook });
  await drive(
    console,
    driver,
    driver.follow!,
    { target_object_ref: person, distance: value.int(distance) },
    name,
    texts.followed(driver.name, name),
  );
}

/** Stops the robot's motions of this console. */
export async function stop(console: Console, driver: Driver): Promise<void> {
  await end_all(console, motions_of(console, driver));
}

async function end_all(console: Console, motions: readonly CommandEntry[]): Promise<void> {
  const components = [...new Set(motions.map((one) => one.component))];
  const stops = await Promise.all(components.map((ref) => console.run(ref, 'stop', {}, { give_back: true })));
  await Promise.all(stops.map((one) => one.ends));
}

// Targets in words, as shown to the user; the command has only coordinates.
const whithers = new WeakMap<CommandEntry, string>();

/** In words, if this page sent the command. */
export function whither_of(entry: CommandEntry | undefined): string | undefined {
  return entry && whithers.get(entry);
}

// Stops another component of the same wheels first; a new start of the same component replaces its motion. The map shows the motion with
// a stop button.
async function drive(
  console: Console,
  driver: Driver,
  ref: string,
  named: Parameters<Console['run']>[2],
  whither: string,
  done: string,
): Promise<void> {
  const { notices, commands } = console;
  const about = `drive ${driver.engine}`;
  notices.dismiss(about);
  await end_all(console, motions_of(console, driver).filter((one) => one.component !== ref));
  const { command_ids, ends } = await console.run(ref, 'start', named, { give_back: true });
  const entry = commands.find(command_ids[0] ?? '');
  if (entry) whithers.set(entry, whither);
  ends.then(
    async ([status]) => {
      if (status === 'OK') notices.show('good', done, { about });
      else if (status !== 'ABORT') {
        const reason = entry && (await commands.fetch_results(entry))?.text('reason');
        const open = () => (entry?.completed === undefined ? show_panel('messages') : show_document(console, entry.completed));
        notices.show('error', texts.failed(whither), { about, detail: reason || status!, action: { label: texts.why(), act: open } });
      } else if (motions_of(console, driver).length === 0) notices.show('info', texts.stopped(driver.name), { about });
    },
    () => undefined, // the session is lost, as the link shows
  );
}
