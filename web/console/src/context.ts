// Access to the state.
import { createContext } from 'preact';
import { useContext, useEffect } from 'preact/hooks';

import type { Stop } from './state/base/environment';
import type { Console } from './state/console';

export const ConsoleContext = createContext<Console | undefined>(undefined);

/** The state and operations; always the same object. */
export function useConsole(): Console {
  const console = useContext(ConsoleContext);
  if (!console) throw new Error('useConsole needs a ConsoleContext');
  return console;
}

/** Watches while the component is mounted: `useWatch(console.status.poll)`. */
export function useWatch(watched: { watch(): Stop }): void {
  useEffect(() => watched.watch(), [watched]);
}
