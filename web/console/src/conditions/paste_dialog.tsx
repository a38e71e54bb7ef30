// Imports a condition from XML.
import { useState } from 'preact/hooks';

import { reason_of } from '../state/base/reason_of';
import { Button, Dialog, TextArea } from '../ui';
import { draft_read } from './reading';
import type { ConditionStore } from './store';
import * as texts from './texts';

export function PasteDialog({ store, open, close }: { store: ConditionStore; open: boolean; close: () => void }) {
  const [text, set_text] = useState('');
  const [error, set_error] = useState<string>();
  const take = () => {
    try {
      const read = draft_read(text);
      const { purpose, event_type, query_type } = store.draft.value;
      const says_purpose = read.event_type !== '' || read.query_type !== '' || /^\s*(<\?[^>]*>\s*)?<(\w+:)?(search|bind_any)\b/.test(text);
      store.change(says_purpose ? read : { ...read, purpose, event_type, query_type });
      set_error(undefined);
      close();
    } catch (caught) {
      const why = reason_of(caught);
      set_error(why === 'no Filter' || why === 'SearchCondition' ? texts.paste_no_condition() : texts.paste_failed(why));
    }
  };
  return (
    <Dialog
      title={texts.paste_title()}
      open={open}
      close={close}
      wide
      actions={
        <Button look="primary" disabled={text.trim() === ''} onClick={take}>
          {texts.paste_take()}
        </Button>
      }
    >
      <TextArea label={texts.as_xml()} hint={texts.paste_hint()} value={text} change={set_text} error={error} rows={14} />
    </Dialog>
  );
}
