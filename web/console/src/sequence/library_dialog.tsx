// Stores sequences in this browser; imports and exports XML.
import { useRef, useState } from 'preact/hooks';

import { reason_of } from '../state/base/reason_of';
import { Button, CopyButton, Dialog, Field, IconButton, save_file, TextArea, TextField } from '../ui';
import { commands_in, new_lane } from './model';
import type { SequenceStore } from './store';
import * as texts from './texts';

export function LibraryDialog({ store, open, close }: { store: SequenceStore; open: boolean; close: () => void }) {
  const [pasted, set_pasted] = useState('');
  const [error, set_error] = useState<string>();
  const file = useRef<HTMLInputElement>(null);
  const take = (name: string, text: string) => {
    try {
      store.open(name, store.read(text));
      set_pasted('');
      set_error(undefined);
      close();
    } catch (caught) {
      const reason = reason_of(caught);
      set_error(reason === 'no CommandUnitSequence' ? texts.no_sequence() : texts.unreadable(reason));
    }
  };
  const chosen_file = async () => {
    const one = file.current?.files?.[0];
    if (one) take(one.name.replace(/\.xml$/i, ''), await one.text());
    if (file.current) file.current.value = '';
  };
  const is_empty = commands_in(store.root.value).length === 0;
  const fresh = () => {
    store.open('', new_lane());
    close();
  };
  return (
    <Dialog title={texts.sequences()} open={open} close={close} wide>
      <div class="sequence-library">
        <section class="sequence-keep" aria-label={texts.this_one()}>
          <h3>{texts.this_one()}</h3>
          <div class="sequence-keep-line">
            <TextField label={texts.name()} value={store.name.value} change={(name) => store.rename(name)} />
            <Button look="primary" disabled={is_empty || store.name.value.trim() === ''} onClick={() => store.keep()}>
              {texts.keep()}
            </Button>
            <Button
              icon="download"
              disabled={is_empty}
              onClick={() => save_file(`${(store.name.value || 'sequence').replace(/[^\w.-]+/g, '_')}.xml`, [store.document])}
            >
              {texts.export_it()}
            </Button>
            <CopyButton small={false} look="quiet" disabled={is_empty} text={() => store.document} label={texts.copy_xml()} />
            <Button look="quiet" icon="plus" onClick={fresh}>
              {texts.new_one()}
            </Button>
          </div>
        </section>
        <section aria-label={texts.kept()}>
          <h3>{texts.kept()}</h3>
          {store.kept.value.size === 0 ? (
            <p class="field-hint">{texts.none_kept()}</p>
          ) : (
            <ul class="sequence-list">
              {[...store.kept.value].map(([name, text]) => (
                <li key={name} class="row-spread">
                  <strong>{name}</strong>
                  <span class="row">
                    <Button small aria-label={texts.open_it(name)} onClick={() => take(name, text)}>
                      {texts.open()}
                    </Button>
                    <IconButton small icon="close" label={texts.drop_it(name)} onClick={() => store.drop(name)} />
                  </span>
                </li>
              ))}
            </ul>
          )}
        </section>
        <section class="sequence-keep" aria-label={texts.import_it()}>
          <h3>{texts.import_it()}</h3>
          <Field
            label={texts.file()}
            control={(props) => (
              <input {...props} ref={file} type="file" accept=".xml,application/xml,text/xml" onChange={() => void chosen_file()} />
            )}
          />
          <TextArea label={texts.paste()} hint={texts.paste_hint()} value={pasted} change={set_pasted} error={error} rows={6} />
          <div>
            <Button disabled={pasted.trim() === ''} onClick={() => take('', pasted)}>
              {texts.take()}
            </Button>
          </div>
        </section>
      </div>
    </Dialog>
  );
}
