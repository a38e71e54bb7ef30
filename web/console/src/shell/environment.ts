// The browser as the state's environment.
import { open_socket } from 'rois-client';

import type { Environment } from '../state/base/environment';

const prefix = 'rois-console.';

/** Stored for this tab; survives a reload. */
export const visit = {
  recall: (): string | undefined => {
    try {
      return sessionStorage.getItem(prefix + 'past') ?? undefined;
    } catch {
      return undefined;
    }
  },
  /** Returns whether it was stored: it may be too large, or storage may be disabled. */
  remember: (text: string): boolean => {
    try {
      sessionStorage.setItem(prefix + 'past', text);
      return true;
    } catch {
      return false;
    }
  },
};

export const browser: Environment = {
  origin: location.origin,
  now: () => Date.now(),
  precise: () => performance.now(),
  every: (ms, act) => {
    const timer = setInterval(act, ms);
    return () => clearInterval(timer);
  },
  after: (ms, act) => {
    const timer = setTimeout(act, ms);
    return () => clearTimeout(timer);
  },
  // A hidden page renders no frames, but pulses must still fire so that memory stays bounded.
  before_frame: (act) => void (document.hidden ? setTimeout(act, 1000) : requestAnimationFrame(act)),
  fetch: (path, init) => fetch(path, init),
  open_socket,
  recall: (name) => {
    try {
      return localStorage.getItem(prefix + name) ?? undefined;
    } catch {
      return undefined; // storage is disabled
    }
  },
  remember: (name, value) => {
    try {
      localStorage.setItem(prefix + name, value);
    } catch {
      // storage is disabled or full
    }
  },
};
