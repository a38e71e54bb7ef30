// Dark or light theme, chosen by the user or the system.
import { computed, effect, signal } from '@preact/signals';

export type Theme = 'system' | 'dark' | 'light';

export const theme = signal<Theme>('system');
const system_is_dark = signal(true);

/** The theme in effect. Canvases must redraw when it changes. */
export const shown_theme = computed<'dark' | 'light'>(() => {
  if (theme.value !== 'system') return theme.value;
  return system_is_dark.value ? 'dark' : 'light';
});

export function follow_system(): void {
  const query = matchMedia('(prefers-color-scheme: dark)');
  const read = () => (system_is_dark.value = query.matches);
  query.addEventListener('change', read);
  read();
  effect(() => {
    document.documentElement.dataset['theme'] = shown_theme.value;
  });
}

/** A custom property of tokens.css, for canvases. */
export function color(name: `--${string}`): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}
