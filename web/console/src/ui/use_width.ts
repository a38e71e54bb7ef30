import type { RefObject } from 'preact';
import { useLayoutEffect, useRef, useState } from 'preact/hooks';

/** Calls `changed` now and whenever the size changes. Returns a function that stops it. */
export function watch_size(element: Element, changed: () => void): () => void {
  const observer = new ResizeObserver(changed);
  observer.observe(element);
  return () => observer.disconnect();
}

/** Whether an element has at least this width. Panels may be narrow on wide screens. */
export function useIsWide(least: number): [RefObject<HTMLDivElement>, boolean] {
  const frame = useRef<HTMLDivElement>(null);
  const [is_wide, set_wide] = useState(false);
  useLayoutEffect(() => watch_size(frame.current!, () => set_wide((frame.current?.clientWidth ?? 0) >= least)), [least]);
  return [frame, is_wide];
}
