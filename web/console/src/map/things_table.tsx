// The things on the floor as a table: always for screen readers, visible on request. Updated once a second.
import { untracked } from '@preact/signals';

import { useConsole } from '../context';
import { Button } from '../ui';
import { acts_text, age, certainty, degrees, position } from './formats';
import type { Shown } from './scene';
import { session_of } from './session';
import * as texts from './texts';

export function ThingsTable() {
  const console = useConsole();
  const session = session_of(console);
  void console.now.value;
  const is_shown = session.shows_table.value;
  const { shown } = untracked(() => session.scene());
  const { chosen } = session.interaction.value;
  const choose = (key: string) => (session.interaction.value = { ...session.interaction.value, target: undefined, chosen: key });
  const table = (
    <table class={is_shown ? 'table' : undefined}>
      <caption class="unseen">{texts.table_label()}</caption>
      <thead>
        <tr>
          {[texts.kind_column(), texts.name(), texts.state(), texts.position(), texts.direction(), texts.certainty(), texts.reported()].map(
            (title) => (
              <th key={title} scope="col">
                {title}
              </th>
            ),
          )}
          {is_shown && (
            <th scope="col">
              <span class="unseen">{texts.choose()}</span>
            </th>
          )}
        </tr>
      </thead>
      <tbody>
        {sorted(shown).map((one) => (
          <tr key={one.key} aria-selected={is_shown ? one.key === chosen : undefined}>
            <td>{texts.kind(one.kind)}</td>
            <th scope="row">
              {one.name}
              {one.identity && <span class="map-soft"> {one.thing.ref}</span>}
              {acts_text(one) !== '' && <span class="map-soft"> {texts.acts_for()} {acts_text(one)}</span>}
            </th>
            <td>{texts.freshness(one.freshness, one.kind, age(one.age))}</td>
            <td>{position(one)}</td>
            <td>{one.th === undefined ? '–' : degrees(one.th)}</td>
            <td>{one.ellipse ? certainty(one.ellipse) : '–'}</td>
            <td>{texts.ago(age(one.age))}</td>
            {is_shown && (
              <td>
                <Button small aria-label={`${texts.choose()}: ${one.name}`} onClick={() => choose(one.key)}>
                  {texts.choose()}
                </Button>
              </td>
            )}
          </tr>
        ))}
      </tbody>
    </table>
  );
  if (!is_shown) return <div class="unseen">{table}</div>;
  return (
    <div class="map-table" role="region" aria-label={texts.table_label()} tabIndex={0}>
      {shown.length === 0 ? <p class="map-soft">{texts.nothing()}</p> : table}
    </div>
  );
}

const order = ['robot', 'person', 'face', 'sound'];

function sorted(shown: readonly Shown[]): Shown[] {
  return [...shown].sort((a, b) => order.indexOf(a.kind) - order.indexOf(b.kind) || a.name.localeCompare(b.name, 'en', { numeric: true }));
}
