// Placeholders and badges.
import type { ComponentChildren } from 'preact';

import { Icon, type IconName } from './icon';
import * as texts from './texts';

export function EmptyState({ icon = 'info', title, children }: { icon?: IconName; title: string; children?: ComponentChildren }) {
  return (
    <div class="state">
      <Icon name={icon} size={24} />
      <p class="state-title">{title}</p>
      {children && <div class="state-more">{children}</div>}
    </div>
  );
}

export function Loading() {
  return (
    <div class="state" role="status">
      <p class="state-title">{texts.loading()}</p>
    </div>
  );
}

/** `calm`: nothing to see; `good`, `busy` (working), `warning`, `bad`. The text says it too, not only the colour. */
export type Tone = 'calm' | 'good' | 'busy' | 'warning' | 'bad';

export function Badge({ tone = 'calm', title, children }: { tone?: Tone; title?: string | undefined; children: ComponentChildren }) {
  return (
    <span class={`badge badge-${tone}`} title={title}>
      {children}
    </span>
  );
}

const tones: Record<string, Tone> = {
  READY: 'good', OK: 'good', open: 'good', resumed: 'good',
  BUSY: 'busy', RUNNING: 'busy', running: 'busy', connecting: 'busy',
  WARNING: 'warning', ABORT: 'warning', token: 'warning', draining: 'warning',
  TIMEOUT: 'bad', ERROR: 'bad', OUT_OF_RESOURCES: 'bad', BAD_PARAMETER: 'bad', UNSUPPORTED: 'bad', lost: 'bad', refused: 'bad',
};

/** The tone of a status or return code, a command's state, or a link phase. */
export function tone_of(code: string): Tone {
  return tones[code] ?? 'calm';
}

/** A component's status, a command's state or a return code. */
export function StatusBadge({ status, title }: { status: string; title?: string | undefined }) {
  return (
    <Badge tone={tone_of(status)} title={title}>
      {status}
    </Badge>
  );
}
