import type { ComponentChildren, JSX } from 'preact';

import { Icon, type IconName } from './icon';
import { joined } from './joined';

type Native = Omit<JSX.IntrinsicElements['button'], 'icon' | 'label'>;

export interface ButtonProps extends Native {
  /** `primary`: the main action; `danger`: stops or destroys; `quiet`: without a frame. */
  look?: 'primary' | 'danger' | 'quiet';
  icon?: IconName;
  small?: boolean;
  /** Working; the button is disabled. */
  busy?: boolean;
  children?: ComponentChildren;
}

export function Button({ look, icon, small, busy, children, disabled, class: more, ...native }: ButtonProps) {
  const name = joined('button', look && `button-${look}`, small && 'button-small', more as string);
  return (
    <button type="button" {...native} class={name} disabled={disabled || busy || false} aria-busy={busy || undefined}>
      {icon && <Icon name={icon} />}
      {children !== undefined && <span>{children}</span>}
    </button>
  );
}

/** A button with only an icon. The label is its tooltip and its name for screen readers. */
export function IconButton({ label, icon, ...rest }: Omit<ButtonProps, 'children' | 'icon'> & { label: string; icon: IconName }) {
  return <Button look="quiet" {...rest} icon={icon} class={`button-icon ${rest.class ?? ''}`} aria-label={label} title={label} />;
}
