// A button that opens a box below it. Escape or moving the focus out closes it.
import type { ComponentChildren } from 'preact';
import { useRef } from 'preact/hooks';

export function Pop({ label, at_right = false, children }: { label: string; at_right?: boolean; children: ComponentChildren }) {
  const box = useRef<HTMLDetailsElement>(null);
  const shut = () => box.current?.removeAttribute('open');
  return (
    <details
      ref={box}
      class={at_right ? 'pop pop-right' : 'pop'}
      onKeyDown={(event) => {
        if (event.key !== 'Escape' || !box.current?.open || (event.target as Element).closest('dialog')) return;
        shut();
        box.current.querySelector('summary')?.focus();
      }}
      onFocusOut={(event) => {
        if (event.relatedTarget && !box.current?.contains(event.relatedTarget as Node)) shut();
      }}
    >
      <summary>{label}</summary>
      <div class="pop-box">{children}</div>
    </details>
  );
}
