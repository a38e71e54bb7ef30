// Who has a component, in words.
import type { Console } from '../state/console';
import * as texts from './texts';

/** Empty: nobody has it. BUSY says that another session has, whether or not the gateway tells which. */
export function holder_text({ bindings, status }: Console, ref: string): string {
  const holder = bindings.holder_of(ref);
  if (holder.who === 'me') return texts.mine();
  if (holder.who === 'other') return texts.other(holder.session);
  return status.of(ref)?.status === 'BUSY' ? texts.other('') : '';
}
