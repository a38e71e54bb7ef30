// How the parts of the page come by the state.
import { createContext } from 'preact';
import { useContext, useEffect } from 'preact/hooks';

import type { Console } from '../state/console';
import type { Stop } from '../state/environment';

export const ConsoleContext = createContext<Console | undefined>(undefined);

/** The state and the operations; the same object for ever. */
export function useConsole(): Console {
  const console = useContext(ConsoleContext);
  if (!console) throw new Error('there is no console around this');
  return console;
}

/** Looks at something that is asked for while somebody looks: `useWatch(console.status.poll)`. */
export function useWatch(watched: { watch(): Stop }): void {
  useEffect(() => watched.watch(), [watched]);
}
