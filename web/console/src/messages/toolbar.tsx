// Filter, pause and recordings.
import { useRef } from 'preact/hooks';

import { useConsole } from '../context';
import * as panel_titles from '../shell/panel_titles';
import { reason_of } from '../state/base/reason_of';
import { read_recording, recording_of } from '../state/session/recording';
import { Button, Checkbox, save_file, SelectField, TextField } from '../ui';
import { categories, type Category, type Feed, type Filter, type Row } from './feed';
import { chosen_of_recording, filter, paused, recording } from './shown';
import * as texts from './texts';

const most_bytes = 64 * 1024 * 1024; // of a recording

export function Toolbar({ feed, rows, all }: { feed: Feed; rows: readonly Row[]; all: number }) {
  const { profile } = useConsole();
  const now = filter.value;
  const put = (some: Partial<Filter>) => (filter.value = { ...now, ...some });
  const toggle = (name: Category) =>
    put({ hidden: now.hidden.has(name) ? new Set([...now.hidden].filter((one) => one !== name)) : new Set([...now.hidden, name]) });
  const tape = recording.value;
  const refs = tape
    ? [...new Set(tape.documents.flatMap((one) => one.component ?? []))].sort()
    : profile.components.value.map((one) => one.ref);
  return (
    <div class="messages-bar" role="group" aria-label={panel_titles.messages()}>
      <h2 class="unseen">{panel_titles.messages()}</h2>
      {!tape && <Pause feed={feed} />}
      <div class="messages-kinds" role="group" aria-label={texts.kinds()}>
        {categories.map((name) => (
          <button
            key={name}
            type="button"
            class="button button-small messages-kind"
            aria-pressed={!now.hidden.has(name)}
            onClick={() => toggle(name)}
          >
            {texts.category(name)}
          </button>
        ))}
      </div>
      <div class="messages-which">
        <SelectField
          label={texts.component()}
          hide_label
          value={now.component}
          change={(component) => put({ component })}
          choices={[{ value: '', label: texts.all_components() }, ...refs.map((ref) => ({ value: ref, label: ref }))]}
        />
        <TextField
          label={texts.search()}
          hide_label
          value={now.text}
          change={(text) => put({ text })}
          input={{ type: 'search', placeholder: texts.search() }}
        />
      </div>
      <Checkbox label={texts.own()} checked={now.with_own} change={(with_own) => put({ with_own })} />
      <span class="messages-count" title={texts.shown_hint()}>{texts.shown(rows.length, Math.max(all, rows.length))}</span>
      <Recordings />
    </div>
  );
}

function Pause({ feed }: { feed: Feed }) {
  const { documents } = useConsole();
  const held = paused.value;
  const end = () => documents.ring.end;
  if (!held)
    return (
      <Button small icon="pause" onClick={() => (paused.value = { rows: [...feed.rows], until: end() })}>
        {texts.pause()}
      </Button>
    );
  return (
    <Button small look="primary" icon="play" onClick={() => (paused.value = undefined)}>
      {texts.go_on()} ({texts.waiting(end() - held.until)})
    </Button>
  );
}

function Recordings() {
  const console = useConsole();
  const chooser = useRef<HTMLInputElement>(null);
  const write = () => {
    const { ring } = console.documents;
    const { size } = ring;
    save_file(
      `rois-${new Date(console.environment.now()).toISOString().slice(0, 19).replaceAll(':', '')}.jsonl`,
      recording_of(ring, console.environment.origin),
    );
    console.notices.show('good', texts.exported(size), { detail: texts.session_inside() });
  };
  const open = async (file: File | undefined) => {
    if (!file) return;
    try {
      if (file.size > most_bytes) throw new Error(texts.too_large(most_bytes));
      const read = read_recording(await file.text());
      recording.value = { ...read, file: file.name };
      chosen_of_recording.value = undefined;
      console.selection.document.value = undefined;
      console.notices.dismiss('recording');
      if (read.is_cut) console.notices.show('warning', texts.is_cut(), { about: 'recording' });
    } catch (error) {
      console.notices.show('error', texts.import_failed(file.name), { detail: reason_of(error), about: 'recording' });
    }
    chooser.current!.value = ''; // so that the same file can be opened again
  };
  return (
    <>
      <Button small icon="download" onClick={write}>
        {texts.export_it()}
      </Button>
      <Button small icon="upload" onClick={() => chooser.current?.click()}>
        {texts.import_it()}
      </Button>
      <input
        ref={chooser}
        type="file"
        class="unseen"
        accept=".jsonl,.json,.rois,text/plain"
        tabIndex={-1}
        aria-label={texts.import_it()}
        onChange={(event) => void open(event.currentTarget.files?.[0])}
      />
    </>
  );
}
