// Unsent input, kept until the page is closed: panels are unmounted when another one is shown.
import { useState } from 'preact/hooks';

const kept = new Map<string, unknown>();
const most = 300;

export function draft<T>(key: string): T | undefined {
  return kept.get(key) as T | undefined;
}

export function useDraft<T>(key: string, usual: T): [T, (to: T) => void] {
  const [, set_renders] = useState(0);
  const put = (to: T) => {
    kept.delete(key);
    kept.set(key, to);
    if (kept.size > most) kept.delete(kept.keys().next().value!);
    set_renders((n) => n + 1);
  };
  return [kept.has(key) ? (kept.get(key) as T) : usual, put];
}
