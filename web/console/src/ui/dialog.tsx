// A native dialog: it traps the focus, closes with Escape and restores the focus.
import type { ComponentChildren } from 'preact';
import { useEffect, useId, useRef } from 'preact/hooks';

import { IconButton } from './button';
import { StopButton } from './stop_button';
import * as texts from './texts';

export interface DialogProps {
  title: string;
  open: boolean;
  /** Called when the user closes it in any way. */
  close: () => void;
  /** If false, only its actions close it. */
  closable?: boolean;
  /** Buttons at the bottom. */
  actions?: ComponentChildren;
  wide?: boolean;
  children: ComponentChildren;
}

export function Dialog({ title, open, close, closable = true, actions, wide = false, children }: DialogProps) {
  const element = useRef<HTMLDialogElement>(null);
  const id = useId();
  useEffect(() => {
    const dialog = element.current;
    if (!dialog) return;
    if (open && !dialog.open) dialog.showModal();
    if (!open && dialog.open) dialog.close();
  }, [open]);
  const cancelled = (event: Event) => {
    event.preventDefault();
    if (closable) close();
  };
  return (
    <dialog
      ref={element}
      class={wide ? 'dialog dialog-wide' : 'dialog'}
      aria-labelledby={id}
      onCancel={cancelled}
      onClose={() => open && closable && close()}
    >
      {open && (
        <>
          <div class="dialog-head">
            <h2 id={id}>{title}</h2>
            <StopButton />
            {closable && <IconButton icon="close" label={texts.close()} onClick={close} />}
          </div>
          <div class="dialog-body">{children}</div>
          {actions && <div class="dialog-actions">{actions}</div>}
        </>
      )}
    </dialog>
  );
}
