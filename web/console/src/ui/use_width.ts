import type { RefObject } from 'preact';
import { useLayoutEffect, useRef, useState } from 'preact/hooks';

/** Tells now and whenever the size of the element changes; gives the function that ends it. */
export function watch_size(element: Element, changed: () => void): () => void {
  const observer = new ResizeObserver(changed);
  observer.observe(element);
  return () => observer.disconnect();
}

/** Whether an element is at least so wide: panels stand in narrow places on wide screens. */
export function useIsWide(least: number): [RefObject<HTMLDivElement>, boolean] {
  const frame = useRef<HTMLDivElement>(null);
  const [is_wide, set_wide] = useState(false);
  useLayoutEffect(() => watch_size(frame.current!, () => set_wide((frame.current?.clientWidth ?? 0) >= least)), [least]);
  return [frame, is_wide];
}
