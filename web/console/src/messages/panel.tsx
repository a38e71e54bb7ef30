// The Messages panel: a list of all documents with a filter, and the selected document.
import './messages.css';

import { useEffect, useMemo, useState } from 'preact/hooks';

import { useConsole } from '../context';
import { is_touched } from '../i18n/i18n';
import type { Console } from '../state/console';
import type { LoggedDocument } from '../state/session/document_log';
import { Button, EmptyState, useIsWide, VirtualList, WidthSplit } from '../ui';
import { categories, Feed, is_gap, no_filter, type Row, type Source } from './feed';
import { Reader } from './reader';
import { RowView } from './row';
import { chosen_of_recording, filter, paused, recording, type ShownRecording } from './shown';
import { command_of, component_of } from './summary';
import * as texts from './texts';
import { Toolbar } from './toolbar';

const look_every = 250; // ms, update period

export default function MessagesPanel() {
  const console = useConsole();
  const [frame, is_wide] = useIsWide(900); // for the list and the document side by side
  const tape = recording.value;
  const feed = useMemo(() => new Feed(tape ? source_of(tape) : live(console), filter.value), [tape, filter.value]);
  // The total: all documents that the filter could show, so without the console's own requests unless they are included.
  const { with_own } = filter.value;
  const whole = useMemo(
    () => new Feed(tape ? source_of(tape) : live(console), { ...no_filter, with_own: with_own || tape !== undefined }),
    [tape, with_own],
  );
  const [, set_renders] = useState(0);
  const is_bare = console.documents.ring.size === 0;
  useEffect(
    () =>
      console.environment.every(look_every, () => {
        const is_new = [feed, whole].filter((one) => one.update()).length > 0;
        if (is_new || (is_bare && console.documents.ring.size > 0)) set_renders((n) => n + 1);
      }),
    [feed, whole, is_bare],
  );
  const held = tape ? undefined : paused.value;
  const rows = held ? held.rows : feed.rows;
  const picked = console.selection.document;
  const choice = tape ? chosen_of_recording : picked;
  const chosen = choice.value;
  const { subscription, wanted } = console.selection;
  useEffect(() => {
    const number = wanted.value;
    if (number === undefined) return;
    recording.value = wanted.value = undefined;
    picked.value = number;
    const document = console.documents.ring.numbered(number);
    if (document && !new Feed(live(console), filter.value).passes(document)) filter.value = { ...no_filter, with_own: document.is_own };
    if (paused.value && !paused.value.rows.some((row) => !is_gap(row) && row.number === number)) paused.value = undefined;
  }, [wanted.value]);
  useEffect(() => {
    if (subscription.value === '') return;
    filter.value = { ...no_filter, hidden: new Set(categories.slice(1)), text: `subscribe_id>${subscription.value}<` };
    recording.value = paused.value = undefined;
    subscription.value = '';
  }, [subscription.value]);
  const document =
    chosen === undefined
      ? undefined
      : tape
        ? tape.documents[chosen]
        : (console.documents.ring.numbered(chosen) ??
          held?.rows.find((one): one is LoggedDocument => !is_gap(one) && one.number === chosen));
  const all = whole.rows.length;

  const list =
    rows.length > 0 ? (
      <VirtualList<Row>
        label={texts.list()}
        rows={rows}
        row_height={is_touched() ? 40 : 26}
        key_of={key_of}
        render={(row) => <RowView row={row} is_live={!tape} />}
        chosen={chosen}
        choose={(row) => (choice.value = is_gap(row) ? undefined : row.number)}
        follow={!tape && !held}
      />
    ) : (
      <EmptyState
        icon="messages"
        title={is_bare && !tape ? texts.none() : filter.value === no_filter ? texts.only_own() : texts.none_pass()}
      >
        {(tape || !is_bare) && <Button onClick={() => (filter.value = { ...no_filter, with_own: true })}>{texts.clear()}</Button>}
      </EmptyState>
    );
  const reader = document ? (
    <Reader
      key={document.number}
      document={document}
      tape={tape}
      choose={({ number }) => ((tape ? chosen_of_recording : wanted).value = number)}
    />
  ) : (
    <EmptyState icon="messages" title={texts.pick()} />
  );
  return (
    <div class="messages" ref={frame}>
      <Toolbar feed={feed} rows={rows} all={all} />
      {tape && <TapeBanner tape={tape} />}
      <div class="messages-body">
        <WidthSplit
          is_wide={is_wide}
          row={{ id: 'messages.row', share: 0.58 }}
          column={{ id: 'messages.column', share: 0.58 }}
          label={texts.list()}
          first={list}
          second={reader}
        />
      </div>
    </div>
  );
}

function TapeBanner({ tape }: { tape: ShownRecording }) {
  return (
    <p class="banner banner-warning" role="status">
      <strong>{texts.not_live()}</strong> {texts.recording(tape.file, tape.documents.length, tape.begun, tape.url)}
      <Button small onClick={() => (recording.value = undefined)}>{texts.to_live()}</Button>
    </p>
  );
}

function key_of(row: Row): string | number {
  return is_gap(row) ? `gap-${row.at}` : row.number;
}

function live({ documents, events, commands }: Console): Source {
  return {
    documents: documents.ring,
    gaps: events.gaps,
    component_of: (one) => component_of(one) || (one.name === 'completed' ? (commands.find(command_of(one))?.component ?? '') : ''),
  };
}

function source_of({ documents }: ShownRecording): Source {
  const none = { first: 0, size: 0, numbered: () => undefined };
  return { documents: { first: 0, end: documents.length, numbered: (number) => documents[number] }, gaps: none, component_of };
}
