import type { RefObject } from 'preact';
import { useLayoutEffect, useRef, useState } from 'preact/hooks';

/** Whether an element is at least so wide: panels stand in narrow places on wide screens. */
export function useIsWide(least: number): [RefObject<HTMLDivElement>, boolean] {
  const frame = useRef<HTMLDivElement>(null);
  const [is_wide, set_wide] = useState(false);
  useLayoutEffect(() => {
    const observer = new ResizeObserver(() => set_wide((frame.current?.clientWidth ?? 0) >= least));
    observer.observe(frame.current!);
    return () => observer.disconnect();
  }, [least]);
  return [frame, is_wide];
}
