// Sequences stored in this browser by name, as XML.
import type { Environment } from '../state/base/environment';

const place = 'sequences';
const most = 100;

type Kept = Pick<Environment, 'recall' | 'remember'>;

/** Sorted by name. */
export function kept_sequences(environment: Kept): ReadonlyMap<string, string> {
  try {
    const read = Object.entries(JSON.parse(environment.recall(place) ?? '{}') as Record<string, unknown>);
    const texts = read.filter((one): one is [string, string] => typeof one[1] === 'string');
    return new Map(texts.sort(([a], [b]) => a.localeCompare(b)));
  } catch {
    return new Map();
  }
}

/** Replaces a sequence of this name. */
export function keep_sequence(environment: Kept, name: string, xml: string): ReadonlyMap<string, string> {
  const others = [...kept_sequences(environment)].filter(([one]) => one !== name).slice(0, most - 1);
  environment.remember(place, JSON.stringify(Object.fromEntries([...others, [name, xml]])));
  return kept_sequences(environment);
}

export function drop_sequence(environment: Kept, name: string): ReadonlyMap<string, string> {
  environment.remember(place, JSON.stringify(Object.fromEntries([...kept_sequences(environment)].filter(([one]) => one !== name))));
  return kept_sequences(environment);
}
