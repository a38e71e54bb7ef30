import { useConsole } from '../context';
import { clock_time, duration } from '../i18n/i18n';
import * as panel_titles from '../shell/panel_titles';
import { Button, Checkbox, IconButton, SelectField } from '../ui';
import * as texts from './texts';
import { type TimeView } from './view';

const spans = [10_000, 30_000, 60_000, 5 * 60_000, 15 * 60_000, 3_600_000];

export function Toolbar({
  view,
  as_table,
  choose_table,
}: {
  view: TimeView;
  as_table: boolean;
  choose_table: (is_chosen: boolean) => void;
}) {
  const console = useConsole();
  const { span, is_all } = view.stretch.value;
  const { is_live } = view;
  const third = span / 3;
  // Updated once a second, so that it can be read.
  const { from, to } = view.range(is_live ? console.now.value : view.sources.at);
  const usual = !is_all && spans.includes(span);
  const choices = spans.map((one) => ({ value: String(one), label: duration(one) }));
  const state_text = () => {
    if (!is_live) return texts.stopped();
    if (!console.link.is_open) return texts.not_live();
    return view.held.value === undefined ? texts.live() : texts.held();
  };
  return (
    <div class="timeline-bar" role="toolbar" aria-label={panel_titles.timeline()}>
      {is_live ? (
        <Button small icon="pause" onClick={() => view.pause()}>{texts.pause()}</Button>
      ) : (
        <Button small look="primary" icon="play" onClick={() => view.go_live()}>{texts.go_live()}</Button>
      )}
      <span class="timeline-shown">
        <strong class={is_live && console.link.is_open ? 'timeline-live' : 'timeline-stopped'}>{state_text()}</strong>{' '}
        {clock_time(from, span < 10_000)} – {clock_time(to, span < 10_000)}
      </span>
      <span class="timeline-buttons">
        <IconButton small icon="left" label={texts.earlier()} onClick={() => view.move(-third)} />
        <IconButton small icon="right" label={texts.later()} disabled={is_live} onClick={() => view.move(third)} />
        <IconButton small icon="minus" label={texts.zoom_out()} onClick={() => view.zoom(1.5)} />
        <IconButton small icon="plus" label={texts.zoom_in()} onClick={() => view.zoom(1 / 1.5)} />
        <IconButton small icon="undo" label={texts.back()} disabled={!view.can_undo} onClick={() => view.undo()} />
      </span>
      <span class="timeline-stretch">
        <SelectField
          label={texts.stretch()}
          hide_label
          value={is_all ? 'all' : usual ? String(span) : 'other'}
          change={(value) => (value === 'all' ? view.show_all() : value !== 'other' && view.set_span(Number(value)))}
          choices={[
            ...(usual || is_all ? [] : [{ value: 'other', label: duration(span) }]),
            ...choices,
            { value: 'all', label: texts.everything() },
          ]}
        />
      </span>
      <span class="timeline-switches">
        <Checkbox
          label={texts.hide_quiet()}
          checked={view.hides_quiet.value}
          change={(is_chosen) => (view.hides_quiet.value = is_chosen)}
        />
        <Checkbox label={texts.with_own()} checked={view.with_own.value} change={(is_chosen) => (view.with_own.value = is_chosen)} />
        <Checkbox label={texts.as_table()} checked={as_table} change={choose_table} />
      </span>
    </div>
  );
}
