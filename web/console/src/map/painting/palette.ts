// The colours of ui/styles/tokens.css for canvases.
import { color } from '../../shell/theme';

const names = {
  ground: '--ground',
  panel: '--panel',
  raised: '--raised',
  line: '--line',
  ink: '--ink',
  soft: '--ink-soft',
  accent: '--accent',
  on_accent: '--ink-on-accent',
  warning: '--warning',
  grid: '--draw-grid',
  wall: '--draw-wall',
  furniture: '--draw-furniture',
  place: '--draw-place',
  robot: '--draw-robot',
  person: '--draw-person',
  face: '--draw-face',
  sound: '--draw-sound',
  path: '--draw-path',
} as const;

export type Palette = Record<keyof typeof names, string> & { font: string };

export function read_palette(): Palette {
  const read = Object.fromEntries(Object.entries(names).map(([name, token]) => [name, color(token)]));
  return { ...read, font: `${color('--text-small')} ${color('--sans')}` } as Palette;
}
