// The browser as the state sees it.
import { open_socket } from 'rois-client';

import type { Environment } from '../state/environment';

const prefix = 'rois-console.';

/** Kept for this visit alone: it outlives a reload, not the tab. */
export const visit = {
  recall: (): string | undefined => {
    try {
      return sessionStorage.getItem(prefix + 'past') ?? undefined;
    } catch {
      return undefined;
    }
  },
  /** Whether it was taken: it may be too much, or the user's settings forbid it. */
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
  // A page that nobody sees draws no pictures, and its memory must stay bounded all the same.
  before_picture: (act) => void (document.hidden ? setTimeout(act, 1000) : requestAnimationFrame(act)),
  fetch: (path, init) => fetch(path, init),
  open_socket,
  recall: (name) => {
    try {
      return localStorage.getItem(prefix + name) ?? undefined;
    } catch {
      return undefined; // the user's settings forbid it
    }
  },
  remember: (name, value) => {
    try {
      localStorage.setItem(prefix + name, value);
    } catch {
      // then it is not remembered
    }
  },
};
