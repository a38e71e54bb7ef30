// The owner of a component as a text.
import type { Console } from '../state/console';
import * as texts from './texts';

/**
 * Empty if no session has bound the component. BUSY means that another session has bound it, even if the gateway does not name that
 * session.
 */
export function holder_text({ bindings, status }: Console, ref: string): string {
  const holder = bindings.holder_of(ref);
  if (holder.who === 'me') return texts.mine();
  if (holder.who === 'other') return texts.other(holder.session);
  return status.of(ref)?.status === 'BUSY' ? texts.other('') : '';
}
