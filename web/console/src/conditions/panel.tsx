// The Conditions panel: builds conditions, shows their Filter Encoding and present matches, and uses them.
import './conditions.css';

import { useState } from 'preact/hooks';

import { useConsole } from '../context';
import { Button, EmptyState, Form, SelectField } from '../ui';
import { Beginnings } from './beginnings';
import { GroupView } from './group_view';
import { MatchesView } from './matches_view';
import { new_group, type Purpose, purposes } from './model';
import { PasteDialog } from './paste_dialog';
import { SortView } from './sort_view';
import { type ConditionStore, store_of } from './store';
import { Subscriptions } from './subscriptions';
import * as texts from './texts';
import { UseView } from './use_view';

export default function ConditionsPanel() {
  const console = useConsole();
  const store = store_of(console);
  const [pasting, set_pasting] = useState(false);
  if (!console.profile.profile.value) return <EmptyState icon="conditions" title={texts.looking()} />;
  const { root, order, purpose } = store.draft.value;
  const clear = () => store.change({ root: new_group(), order: [] });
  const is_empty = root.members.length === 0 && order.length === 0;
  return (
    <div class="conditions">
      <Form class="conditions-frame">
        <div class="conditions-build">
          <PurposeView store={store} />
          <section class="conditions-part" aria-label={texts.conditions()}>
            <div class="row-spread">
              <h2>{texts.heading()}</h2>
              <div class="row">
                <Button small look="quiet" icon="upload" onClick={() => set_pasting(true)}>
                  {texts.paste()}
                </Button>
                <Button small look="quiet" icon="close" disabled={is_empty} onClick={() => clear()}>
                  {texts.clear()}
                </Button>
              </div>
            </div>
            {is_empty && <Beginnings store={store} />}
            <GroupView store={store} group={root} />
          </section>
          {purpose !== 'subscribe' && <SortView store={store} />}
        </div>
        <div class="conditions-outcomes">
          <MatchesView store={store} />
          <Subscriptions store={store} />
          <UseView store={store} />
        </div>
      </Form>
      <PasteDialog store={store} open={pasting} close={() => set_pasting(false)} />
    </div>
  );
}

function PurposeView({ store }: { store: ConditionStore }) {
  const { profile } = useConsole();
  const draft = store.draft.value;
  const names = (kind: 'events' | 'queries') =>
    [...new Set(profile.components.value.flatMap((one) => one[kind].map(({ name }) => name)))].sort();
  const choose = (purpose: Purpose) => {
    const event_type = purpose === 'subscribe' && draft.event_type === '' ? usual(names('events'), 'person_localized') : draft.event_type;
    const query_type = purpose === 'query' && draft.query_type === '' ? usual(names('queries'), 'component_status') : draft.query_type;
    store.change({ purpose, event_type, query_type });
  };
  const choices = (all: string[], chosen: string) =>
    [...(all.includes(chosen) ? [] : [chosen]), ...all].map((value) => ({ value, label: value === '' ? texts.choose() : value }));
  return (
    <section class="conditions-part conditions-purpose" aria-label={texts.purpose()}>
      <fieldset class="conditions-purposes">
        <legend class="unseen">{texts.purpose()}</legend>
        {purposes.map((one) => (
          <label key={one} class="conditions-radio">
            <input type="radio" name="conditions-purpose" checked={draft.purpose === one} onChange={() => choose(one)} />
            <span>{texts.purpose_named(one)}</span>
          </label>
        ))}
      </fieldset>
      {draft.purpose === 'subscribe' && (
        <SelectField
          label={texts.event()}
          value={draft.event_type}
          change={(event_type) => store.change({ event_type })}
          choices={choices(names('events'), draft.event_type)}
        />
      )}
      {draft.purpose === 'query' && (
        <SelectField
          label={texts.query()}
          value={draft.query_type}
          change={(query_type) => store.change({ query_type })}
          choices={choices(names('queries'), draft.query_type)}
        />
      )}
    </section>
  );
}

function usual(all: string[], wished: string): string {
  return all.includes(wished) ? wished : (all[0] ?? '');
}
