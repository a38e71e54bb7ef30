// Toolbar of the map: Observe, places, layers, table, help.
import { useSignal } from '@preact/signals';

import { useConsole } from '../context';
import * as panel_titles from '../shell/panel_titles';
import { Badge, Button, Checkbox, error_text, Pop } from '../ui';
import { Help } from './help';
import { all_layers, type Layers } from './painting/ground';
import { age } from './formats';
import { session_of } from './session';
import * as texts from './texts';

export function Toolbar() {
  const session = session_of(useConsole());
  const is_helping = useSignal(false);
  const shows_table = session.shows_table.value;
  return (
    <div class="map-bar">
      <h2>{session.map?.name || panel_titles.map()}</h2>
      <Observe />
      <div class="map-bar-end">
        <PlaceChoice />
        <LayerChoice />
        <Button small icon="table" aria-pressed={shows_table} onClick={() => session.show_table(!shows_table)}>
          {texts.table()}
        </Button>
        <Button small icon="help" onClick={() => (is_helping.value = true)}>
          {texts.help()}
        </Button>
      </div>
      <Help open={is_helping.value} close={() => (is_helping.value = false)} />
    </div>
  );
}

const fresh_for = 30_000; // ms, maximum age of a current report

function Observe() {
  const console = useConsole();
  const { observer } = session_of(console);
  const { entities, now } = console;
  void entities.pulse.beat.value;
  const { is_wanted, is_busy, on, refused } = observer.state.value;
  const of = observer.components.length;
  const old = now.value - entities.reported_at; // ms
  const is_blind = on.length > 0 && entities.is_blind();
  const is_fresh = old < fresh_for;
  const is_silent = entities.reported_at === 0;
  const freshness = is_blind ? texts.observe_blind() : is_silent ? texts.observe_silent() : texts.observe_age(age(old));
  const why = refused.map(({ ref, error }) => `${ref}: ${error_text(error)}`).join('\n');
  return (
    <div class="map-observe">
      <button
        type="button"
        role="switch"
        class="map-switch"
        aria-checked={is_wanted}
        aria-busy={is_busy}
        disabled={of === 0 || (!console.link.is_open && !is_wanted)}
        title={of === 0 ? texts.observe_none() : texts.observe_hint()}
        onClick={() => void observer.turn_to(!is_wanted)}
      >
        <span class="map-switch-track" aria-hidden="true" />
        {texts.observe()}
      </button>
      {is_wanted && !console.link.is_open && <Badge>{texts.observe_unlinked()}</Badge>}
      {is_wanted && console.link.is_open && (
        <Badge tone={refused.length > 0 || is_blind ? 'warning' : on.length === of && is_fresh ? 'good' : 'busy'} title={why || undefined}>
          {texts.observing(on.length, of)}, {freshness}
        </Badge>
      )}
      {refused.length > 0 && (
        <Pop label={texts.observe_refused()}>
          <ul class="plain-list">
            {refused.map(({ ref, error }) => (
              <li key={ref}>
                <code>{ref}</code>: {error_text(error)}
              </li>
            ))}
          </ul>
        </Pop>
      )}
    </div>
  );
}

/** Chooses a place as the target. */
export function PlaceChoice() {
  const session = session_of(useConsole());
  const places = session.map?.places ?? [];
  const target = session.interaction.value.target;
  if (places.length === 0) return null;
  const choose = (name: string) => {
    const place = places.find((one) => one.name === name);
    if (place)
      session.interaction.value = {
        ...session.interaction.value,
        chosen: undefined,
        target: { x: place.x, y: place.y, th: place.heading, place: name },
      };
  };
  return (
    <label class="map-places">
      <span class="unseen">{texts.go_to_place()}</span>
      <select value={target?.place ?? ''} onChange={(event) => choose(event.currentTarget.value)}>
        <option value="">{texts.go_to()} …</option>
        {places.map(({ name }) => (
          <option key={name} value={name}>
            {name}
          </option>
        ))}
      </select>
    </label>
  );
}

function LayerChoice() {
  const session = session_of(useConsole());
  const names = Object.keys(all_layers) as (keyof Layers)[];
  return (
    <Pop label={texts.layers()} at_right>
      {names.map((name) => (
        <Checkbox
          key={name}
          label={texts.layer(name)}
          checked={session.layers.value[name]}
          change={(is_shown) => session.show(name, is_shown)}
        />
      ))}
    </Pop>
  );
}
