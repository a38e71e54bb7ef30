import { RoisError } from 'rois-client';

import { reason_of } from '../state/base/reason_of';
import type { Notices } from '../state/notices';
import * as texts from './texts';

/** Shows a notice if it fails. Success removes an earlier notice `about` the same. */
export function tried({ notices }: { notices: Notices }, about: string, done: Promise<unknown>): void {
  done.then(
    () => notices.dismiss(about),
    (error: unknown) => notices.show('error', error_text(error), { about }),
  );
}

/** Why a call failed, in the user's language; followed by the engine's reason in English. */
export function error_text(error: unknown): string {
  if (!(error instanceof RoisError)) return reason_of(error);
  switch (error.failure) {
    case 'refused':
      if (error.return_code === 'OUT_OF_RESOURCES') return `${texts.out_of_resources()} (${error.message})`;
      if (error.return_code === 'UNSUPPORTED') return `${texts.unsupported()} (${error.message})`;
      return texts.refused(error.message);
    case 'fault':
      return texts.fault(error.message);
    case 'deadline':
      return texts.deadline();
    case 'link_lost':
      return texts.link_lost();
    case 'session_lost':
      return texts.session_lost();
    case 'closed':
      return texts.closed();
    default:
      return error.message;
  }
}
