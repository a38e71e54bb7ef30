// An area: a place by name, a box by its corners, or a point; typed or picked on a map.
import { useConsole } from '../context';
import { SelectField, TextField } from '../ui';
import { AreaPicker } from './area_picker';
import { is_number } from './checking';
import type { Area } from './model';
import * as texts from './texts';
import type { Known } from './vocabulary';

export interface AreaFieldsProps {
  area: Area;
  change: (area: Area) => void;
  error?: string;
  hint?: string;
  known: Known;
  distance?: string;
  change_distance?: (distance: string) => void;
  distance_complaint?: { error?: string; hint?: string };
}

export function AreaFields({ area, change, error, hint, known, distance, change_distance, distance_complaint }: AreaFieldsProps) {
  const set = (name: keyof Area) => (value: string) => change({ ...area, [name]: value });
  const number = (name: 'x' | 'y' | 'x2' | 'y2', label: string) => (
    <TextField
      label={label}
      unit="mm"
      value={area[name]}
      change={set(name)}
      error={area[name].trim() === '' || is_number(area[name]) ? undefined : texts.problem_named('no_number')}
      input={{ inputMode: 'numeric' }}
    />
  );
  const radius = Number(distance) > 0 ? Number(distance) : undefined;
  return (
    <div class="conditions-area">
      <div class="conditions-numbers">
        {area.kind === 'place' && (
          <TextField label={texts.place()} value={area.place} change={set('place')} options={known.places} error={error} hint={hint} />
        )}
        {area.kind === 'box' && (
          <>
            {number('x', texts.corner(1, 'x'))}
            {number('y', texts.corner(1, 'y'))}
            {number('x2', texts.corner(2, 'x'))}
            {number('y2', texts.corner(2, 'y'))}
          </>
        )}
        {area.kind === 'point' && (
          <>
            {number('x', texts.at('x'))}
            {number('y', texts.at('y'))}
          </>
        )}
        {change_distance && (
          <TextField
            label={texts.distance()}
            unit="mm"
            value={distance ?? ''}
            change={change_distance}
            {...distance_complaint}
            input={{ inputMode: 'numeric' }}
          />
        )}
        {area.kind !== 'place' && <FrameField crs={area.crs} change={set('crs')} />}
      </div>
      <AreaPicker area={area} change={change} radius={radius} />
    </div>
  );
}

// Only if there are several frames.
function FrameField({ crs, change }: { crs: string; change: (crs: string) => void }) {
  const view = useConsole().map.view.value;
  const frames = view.state === 'there' ? view.map.robots.flatMap((one) => (one.frame ? [one.frame.crs] : [])) : [];
  const all = [...new Set([...frames, ...(crs === '' ? [] : [crs])])];
  if (all.length === 0) return null;
  return (
    <SelectField
      label={texts.frame()}
      value={crs}
      change={change}
      choices={[{ value: '', label: texts.frame_engine() }, ...all.map((one) => ({ value: one, label: one }))]}
    />
  );
}
