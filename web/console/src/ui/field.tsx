// A control with label, hint and error.
import type { ComponentChildren, JSX } from 'preact';
import { useId } from 'preact/hooks';

import { joined } from './joined';
import * as texts from './texts';

export interface FieldProps {
  label: string;
  hint?: string | undefined;
  /** Empty or missing: valid. */
  error?: string | undefined;
  unit?: string | undefined; // `mm`, shown after the control
  required?: boolean;
  /** Only for screen readers. */
  hide_label?: boolean;
}

/** The attributes that connect a control with its label, hint and error. */
export interface ControlProps {
  id: string;
  'aria-describedby': string | undefined;
  'aria-invalid': boolean;
  'aria-required': boolean;
}

export function Field({
  label,
  hint,
  error,
  unit,
  required = false,
  hide_label = false,
  control,
}: FieldProps & { control: (props: ControlProps) => ComponentChildren }) {
  const id = useId();
  const described = joined(hint && `${id}-hint`, error && `${id}-error`);
  const props: ControlProps = { id, 'aria-describedby': described || undefined, 'aria-invalid': Boolean(error), 'aria-required': required };
  return (
    <div class="field">
      <label for={id} class={hide_label ? 'unseen' : undefined}>
        {label}
        {required && <span class="field-required" title={texts.required()} aria-hidden="true">*</span>}
      </label>
      <div class="field-control">
        {control(props)}
        {unit && <span class="field-unit">{unit}</span>}
      </div>
      {hint && <p id={`${id}-hint`} class="field-hint">{hint}</p>}
      {error && <p id={`${id}-error`} class="field-error">{error}</p>}
    </div>
  );
}

type Input = Omit<JSX.IntrinsicElements['input'], 'value' | 'onChange' | 'label'>;

export interface TextFieldProps extends FieldProps {
  value: string;
  change: (value: string) => void;
  input?: Input;
  /** Suggestions; other texts may be typed. */
  options?: readonly string[] | undefined;
}

export function TextField({ value, change, input, options, ...field }: TextFieldProps) {
  const list = useId();
  return (
    <Field
      {...field}
      control={(props) => (
        <>
          <input
            type="text"
            autocomplete="off"
            spellcheck={false}
            {...input}
            {...props}
            list={options ? list : undefined}
            value={value}
            onInput={(event) => change(event.currentTarget.value)}
          />
          {options && (
            <datalist id={list}>
              {options.map((one) => <option key={one} value={one} />)}
            </datalist>
          )}
        </>
      )}
    />
  );
}

export function TextArea({
  value,
  change,
  rows = 3,
  ...field
}: FieldProps & { value: string; change: (value: string) => void; rows?: number }) {
  return (
    <Field
      {...field}
      control={(props) => (
        <textarea {...props} rows={rows} spellcheck={false} value={value} onInput={(event) => change(event.currentTarget.value)} />
      )}
    />
  );
}

export interface Choice<T extends string> {
  value: T;
  label: string;
  disabled?: boolean;
}

export function SelectField<T extends string>({
  value,
  change,
  choices,
  ...field
}: FieldProps & { value: T; change: (value: T) => void; choices: readonly Choice<T>[] }) {
  return (
    <Field
      {...field}
      control={(props) => (
        <select {...props} value={value} onChange={(event) => change(event.currentTarget.value as T)}>
          {choices.map((one) => (
            <option key={one.value} value={one.value} disabled={one.disabled ?? false}>
              {one.label}
            </option>
          ))}
        </select>
      )}
    />
  );
}

export function Checkbox({
  label,
  checked,
  change,
  disabled = false,
}: {
  label: string;
  checked: boolean;
  change: (checked: boolean) => void;
  disabled?: boolean;
}) {
  return (
    <label class="checkbox">
      <input type="checkbox" checked={checked} disabled={disabled} onChange={(event) => change(event.currentTarget.checked)} />
      <span>{label}</span>
    </label>
  );
}
