// Explains why a command failed, from the engine's results and the console's knowledge of the hall.
import { pose_of } from 'rois-client';

import type { Console } from '../state/console';
import type { Bounds, FloorMap } from '../state/floor/floor_map';
import type { CommandEntry } from '../state/session/commands_state';
import * as texts from './exchange_texts';

const most_errors = 3;

/** Sentences, the most reliable first: the engine's reason, then the console's findings. */
export function why(console: Console, entry: CommandEntry): string[] {
  const reasons =
    entry.results?.parameters.filter((one) => one.name !== 'status').map((one) => `${one.name}: ${one.values.join('; ')}`) ?? [];
  if (entry.state === 'OK' || entry.state === 'waiting' || entry.state === 'running') return reasons;
  const errors = console.events.errors
    .list()
    .filter(({ error, at }) => error.component_ref?.code === entry.component && at >= entry.sent_at && at <= (entry.ended_at ?? at))
    .slice(-most_errors)
    .map(({ error, details }) =>
      [
        texts.reported_error(error.error_type),
        ...(details.state === 'there' ? details.results.parameters.map((one) => `${one.name}: ${one.values.join('; ')}`) : []),
      ].join(' '),
    );
  const found = entry.state === 'ERROR' ? misplaced(console, entry) : entry.state === 'OUT_OF_RESOURCES' ? in_use(console, entry) : [];
  return [...reasons, ...errors, ...found];
}

/** Target positions that are outside the map or inside furniture. Also shown before sending. */
export function misplaced({ map }: Console, entry: Pick<CommandEntry, 'arguments'>): string[] {
  const view = map.view.value;
  if (view.state !== 'there') return [];
  return entry.arguments
    .filter((one) => /position/i.test(one.name))
    .flatMap((one) => one.values.flatMap((text) => misplaced_text(view.map, text)));
}

function misplaced_text({ bounds, furniture }: FloorMap, text: string): string[] {
  const pose = pose_of(text);
  if (!pose) return [];
  if (!is_inside(bounds, pose))
    return [texts.outside(text, `x ${bounds.x} … ${bounds.x + bounds.width}`, `y ${bounds.y} … ${bounds.y + bounds.depth}`)];
  return furniture.some((one) => is_inside(one, pose)) ? [texts.in_furniture(text)] : [];
}

function is_inside({ x, y, width, depth }: Bounds, at: { x: number; y: number }): boolean {
  return at.x >= x && at.x <= x + width && at.y >= y && at.y <= y + depth;
}

function in_use({ commands, profile }: Console, entry: CommandEntry): string[] {
  const engine = profile.component(entry.component)?.engine;
  const others = commands.all
    .list()
    .filter((one) => one.component !== entry.component && profile.component(one.component)?.engine === engine)
    .filter(
      (one) => one.sent_at <= (entry.ended_at ?? 0) && (one.ended_at ?? Infinity) >= (entry.ended_at ?? 0) && one.state !== 'waiting',
    );
  const names = [...new Set(others.map((one) => `${one.component} ${one.command_type}`))];
  return names.length === 0 ? [] : [texts.in_use(names.join(', '))];
}
