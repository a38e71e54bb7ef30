// A field for one parameter.
import { useId } from 'preact/hooks';

import { Field, IconButton, joined } from '../ui';
import { type DataType, data_type, type Problem } from './data_type';
import { type Asked, fixed_length, is_position, shown_description, units_of } from './describe';
import type { Input } from './inputs';
import type { Options } from './options';
import * as texts from './texts';

export interface ParameterFieldProps {
  asked: Asked;
  input: Input | undefined;
  change: (input: Input | undefined) => void;
  problem?: Problem | undefined;
  options: Options;
  /** The component's current value, shown in an empty field. */
  now?: string | undefined;
}

export function ParameterField(props: ParameterFieldProps) {
  const { asked, problem } = props;
  const type = data_type(asked.data_type_ref.code);
  const called = props.options.list.find((one) => one.value === props.input?.texts[0]?.trim())?.label; // of the chosen option
  const hint = joined(
    !props.options.is_closed && called && `“${called}”.`,
    shown_description(asked.description),
    texts.of_type(asked.data_type_ref.code),
    asked.default_value && texts.preset(asked.default_value),
  );
  const shared = { label: asked.name, hint, error: problem && texts.problem(problem), required: asked.need.kind === 'needed' };
  if (type.is_list) return <ListField {...props} type={type} {...shared} />;
  const unit = units_of(asked.description);
  return (
    <Field
      {...shared}
      {...(unit.length > 0 && { unit: unit.join(', ') })}
      control={(own) => (
        <>
          <Item {...props} type={type} own={own} text={props.input?.texts[0] ?? ''} put={(text) => props.change({ texts: [text] })} />
          {type.kind === 'text' && !props.options.is_closed && <EmptyToggle {...props} />}
        </>
      )}
    />
  );
}

type Shared = { label: string; hint: string; error: string | undefined; required: boolean };

function ListField({ type, label, hint, error, required, ...props }: ParameterFieldProps & Shared & { type: DataType }) {
  const { asked, input, change } = props;
  const id = useId();
  const fixed = fixed_length(asked);
  const units = fixed > 0 ? units_of(asked.description) : [];
  const items = [...(input?.texts ?? [])];
  while (items.length < Math.max(1, fixed)) items.push('');
  const put = (index: number, text: string) => change({ texts: items.map((one, i) => (i === index ? text : one)) });
  const without = (index: number) => change({ texts: items.filter((_, i) => i !== index) });
  return (
    <div class="field" role="group" aria-labelledby={id} aria-describedby={`${id}-hint`}>
      <span id={id} class="form-list-label">
        {label}
        {required && <span class="field-required" aria-hidden="true">*</span>}
      </span>
      {items.map((text, i) => (
        <div key={i} class="field-control">
          <Item
            {...props}
            type={type}
            own={{
              'aria-label': texts.item(label, i + 1),
              'aria-invalid': Boolean(error),
              'aria-describedby': error ? `${id}-error` : undefined,
            }}
            text={text}
            put={(to) => put(i, to)}
          />
          {units[i] && <span class="field-unit">{units[i]}</span>}
          {fixed === 0 && items.length > 1 && (
            <IconButton small icon="close" label={texts.remove(label, i + 1)} onClick={() => without(i)} />
          )}
          {fixed === 0 && i === items.length - 1 && (
            <IconButton
              small
              icon="plus"
              label={texts.add(label)}
              disabled={text.trim() === ''}
              onClick={() => change({ texts: [...items, ''] })}
            />
          )}
          {i === 0 && items.length === 1 && <EmptyToggle {...props} />}
        </div>
      ))}
      <p id={`${id}-hint`} class="field-hint">{hint}</p>
      {error && <p id={`${id}-error`} class="field-error">{error}</p>}
    </div>
  );
}

interface ItemProps extends Pick<ParameterFieldProps, 'asked' | 'input' | 'options' | 'now'> {
  type: DataType;
  own: object; // attributes that connect it to its label
  text: string;
  put: (text: string) => void;
}

const long = /ssml|grammar|xml|document/i;

function Item({ asked, input, options, now, type, own, text, put }: ItemProps) {
  const list = useId();
  const preset = now !== undefined ? texts.now(now) : (asked.default_value ?? (is_position(asked) ? texts.position() : ''));
  if (options.is_closed)
    return (
      <select {...own} value={text} onChange={(event) => put(event.currentTarget.value)}>
        <option value="">{preset === '' ? texts.left_out() : `${texts.left_out()} (${preset})`}</option>
        {options.list.map((one) => <option key={one.value} value={one.value}>{one.label ?? one.value}</option>)}
      </select>
    );
  const placeholder = input?.is_empty ? texts.is_empty() : preset;
  if (type.kind === 'text' && !type.is_list && long.test(asked.name))
    return (
      <textarea
        {...own}
        rows={3}
        spellcheck={false}
        placeholder={placeholder}
        value={text}
        onInput={(event) => put(event.currentTarget.value)}
      />
    );
  const mode = type.kind === 'integer' ? 'numeric' : type.kind === 'number' ? 'decimal' : undefined;
  return (
    <>
      <input
        {...own}
        type="text"
        autocomplete="off"
        spellcheck={false}
        placeholder={placeholder}
        {...(mode && { inputMode: mode })}
        {...(options.list.length > 0 && { list })}
        value={text}
        onInput={(event) => put(event.currentTarget.value)}
      />
      {options.list.length > 0 && (
        <>
          <datalist id={list}>
            {options.list.map((one) => <option key={one.value} value={one.value} label={one.label} />)}
          </datalist>
          <select
            class="form-choose"
            aria-label={texts.choose()}
            title={texts.choose()}
            value=""
            onChange={(event) => put(event.currentTarget.value)}
          >
            <option value="" disabled hidden />
            {options.list.map(({ value, label = value }) => (
              <option key={value} value={value}>
                {label.includes(value) ? label : `${value} – ${label}`}
              </option>
            ))}
          </select>
        </>
      )}
    </>
  );
}

// An empty text is a value: it clears the parameter.
function EmptyToggle({ asked, input, change }: ParameterFieldProps) {
  const is_empty = input?.is_empty === true;
  return (
    <IconButton
      small
      icon="empty"
      class="form-empty"
      aria-pressed={is_empty}
      label={texts.send_empty(asked.name)}
      disabled={(input?.texts ?? []).some((text) => text !== '')}
      onClick={() => change(is_empty ? undefined : { texts: [], is_empty: true })}
    />
  );
}
