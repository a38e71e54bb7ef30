// The value of a comparison: a text, number, time or choice.
import { Field, SelectField, TextField } from '../ui';
import type { Found, ProblemField } from './checking';
import type { Predicate } from './model';
import * as texts from './texts';
import { has_two_values, is_temporal, type Reference } from './vocabulary';

/** The problem of a field: an error if the value is wrong, a hint if it is missing. */
export function complaint_of(found: readonly Found[], field: ProblemField): { error?: string; hint?: string } {
  const one = found.find((each) => each.field === field);
  if (!one) return {};
  const text = texts.problem_named(one.problem);
  return one.is_missing ? { hint: text } : { error: text };
}

interface Props {
  predicate: Predicate;
  reference: Reference | undefined;
  found: readonly Found[];
  change: (to: Partial<Predicate>) => void;
}

export function ValueFields({ predicate, reference, found, change }: Props) {
  if (predicate.operator === 'Null') return null;
  const two = has_two_values(predicate.operator);
  return (
    <div class="conditions-values">
      <ValueField
        label={two ? texts.lower() : texts.value()}
        value={predicate.value}
        change={(value) => change({ value })}
        {...complaint_of(found, 'value')}
        predicate={predicate}
        reference={reference}
      />
      {two && (
        <ValueField
          label={texts.upper()}
          value={predicate.upper}
          change={(upper) => change({ upper })}
          {...complaint_of(found, 'upper')}
          predicate={predicate}
          reference={reference}
        />
      )}
    </div>
  );
}

interface FieldProps {
  label: string;
  value: string;
  change: (value: string) => void;
  error?: string;
  hint?: string;
  predicate: Predicate;
  reference: Reference | undefined;
}

function ValueField({ predicate: { operator }, reference, ...field }: FieldProps) {
  if (is_temporal(operator)) return <TimeField {...field} />;
  if (operator === 'Like') return <TextField {...field} hint={field.hint ?? texts.pattern_hint()} />;
  const { options = [], is_closed = false, type = 'text', unit = '' } = reference ?? {};
  if (type === 'bool' || (is_closed && options.length > 0)) {
    const { value } = field;
    const listed = type === 'bool' ? ['true', 'false'] : options;
    const all = value === '' || listed.includes(value) ? listed : [value, ...listed];
    const choices = all.map((one) => ({ value: one, label: shown(one) }));
    return <SelectField {...field} choices={value === '' ? [{ value: '', label: texts.choose() }, ...choices] : choices} />;
  }
  return <TextField {...field} unit={unit || undefined} options={options} input={type === 'number' ? { inputMode: 'decimal' } : {}} />;
}

// The last part of a URN.
function shown(option: string): string {
  if (option === 'true') return texts.is_true();
  if (option === 'false') return texts.is_false();
  return option.startsWith('urn:') ? `${option.slice(option.lastIndexOf(':') + 1)} (${option})` : option;
}

/** A native field in local time; the condition has UTC. */
function TimeField({ value, change, ...field }: Omit<FieldProps, 'predicate' | 'reference'>) {
  const read = (text: string) => (Number.isNaN(new Date(text).getTime()) ? '' : new Date(text).toISOString());
  return (
    <Field
      {...field}
      control={(props) => (
        <input
          {...props}
          type="datetime-local"
          step="1"
          value={local_text(value)}
          onChange={(event) => change(read(event.currentTarget.value))}
        />
      )}
    />
  );
}

function local_text(iso: string): string {
  const time = new Date(iso);
  if (Number.isNaN(time.getTime())) return '';
  const two = (n: number) => String(n).padStart(2, '0');
  const date = `${time.getFullYear()}-${two(time.getMonth() + 1)}-${two(time.getDate())}`;
  return `${date}T${two(time.getHours())}:${two(time.getMinutes())}:${two(time.getSeconds())}`;
}
