// The Visitors panel: lets simulated persons in, moves them, makes them speak and gesture; and lets simulated time pass.
import './visitors.css';

import { useConsole, useWatch } from '../context';
import { duration } from '../i18n/i18n';
import { gestures, type Visitor } from '../state/floor/hall_state';
import { Badge, Button, Checkbox, EmptyState, Form, Loading, SelectField, TextField } from '../ui';
import { Floor } from './floor';
import { languages, type Steering, steering_of } from './steering';
import * as texts from './texts';

export default function VisitorsPanel() {
  const console = useConsole();
  const { hall, profile } = console;
  useWatch(hall.poll);
  const component = hall.component.value;
  void hall.pulse.beat.value;
  const view = console.map.view.value;
  if (!profile.profile.value) return <Loading />;
  if (!component)
    return (
      <EmptyState icon="person" title={texts.none_here()}>
        {texts.none_here_hint()} <code>--steering on</code>
      </EmptyState>
    );
  const steering = steering_of(console);
  const chosen = hall.visitors.get(steering.chosen.value);
  return (
    <div class="visitors-panel">
      {hall.stands_still.value && <Time steering={steering} />}
      <Floor map={view.state === 'there' ? view.map : undefined} />
      <fieldset class="visitors-people" disabled={!console.link.is_open}>
        <Entering steering={steering} />
        <Who steering={steering} />
        {chosen?.steered ? (
          <Orders key={chosen.ref} steering={steering} visitor={chosen} />
        ) : (
          <p class="soft">{chosen ? texts.of_scenario_hint() : texts.choose_somebody()}</p>
        )}
      </fieldset>
    </div>
  );
}

function Entering({ steering }: { steering: Steering }) {
  const { hall, commands } = useConsole();
  void hall.pulse.beat.value;
  void commands.pulse.beat.value;
  const name = steering.name.value.trim();
  const wrong = hall.is_taken(name) ? texts.name_taken() : /[\s.:]/.test(name) ? texts.name_wrong() : undefined;
  return (
    <Form class="visitors-entering" submit={() => wrong === undefined && steering.enter()}>
      <TextField
        label={texts.name()}
        value={steering.name.value}
        change={(to) => (steering.name.value = to)}
        error={wrong}
        input={{ placeholder: steering.next_name(), maxLength: 64 }}
      />
      <SelectField
        label={texts.language()}
        value={steering.language.value}
        change={(to) => (steering.language.value = to)}
        choices={languages.map((one) => ({ value: one, label: one }))}
      />
      <Checkbox label={texts.known()} checked={steering.is_known.value} change={(to) => (steering.is_known.value = to)} />
      <Button look="primary" icon="plus" type="submit" disabled={wrong !== undefined}>{texts.let_in()}</Button>
    </Form>
  );
}

function Who({ steering }: { steering: Steering }) {
  const console = useConsole();
  const { hall, commands, link } = console;
  void hall.pulse.beat.value;
  void commands.pulse.beat.value;
  const is_known = hall.reported_at > 0;
  const all = [...hall.visitors.values()];
  return (
    <section class="visitors-who" aria-label={texts.who()}>
      <h2>{is_known ? texts.in_hall(all.length) : texts.not_known()}</h2>
      {is_known && !link.is_open ? (
        <p class="soft">{texts.as_it_was(duration(console.time() - hall.reported_at))}</p>
      ) : (
        is_known && all.length === 0 && <p class="soft">{texts.nobody()}</p>
      )}
      <ul>
        {all.map((one) => {
          const doing = hall.orders_of(one.ref).map(({ command_type }) => texts.doing(command_type));
          return (
            <li key={one.ref}>
              <button
                type="button"
                class="visitors-one"
                aria-pressed={one.ref === steering.chosen.value}
                onClick={() => (steering.chosen.value = one.ref)}
              >
                <span class="visitors-ref">{one.ref}</span>
                {one.known && <Badge>{texts.is_known()}</Badge>}
                {!one.steered && <span class="soft">{texts.of_scenario()}</span>}
                {doing.length > 0 && <Badge tone="busy">{[...new Set(doing)].join(', ')}</Badge>}
                <span class="visitors-at">{texts.metres((one.x / 1000).toFixed(1), (one.y / 1000).toFixed(1))}</span>
              </button>
            </li>
          );
        })}
        {hall.awaited().map((ref) => (
          <li key={ref} class="row-spread">
            {ref} <Badge tone="busy">{texts.waits()}</Badge>
          </li>
        ))}
      </ul>
    </section>
  );
}

function Orders({ steering, visitor: { ref } }: { steering: Steering; visitor: Visitor }) {
  const { hall, map } = useConsole();
  const view = map.view.value;
  const places = view.state === 'there' ? view.map.places.map(({ name }) => name) : [];
  const place = places.includes(steering.place.value) ? steering.place.value : (places[0] ?? '');
  const say = () => {
    const text = steering.words.value.trim();
    if (text === '') return;
    void steering.order(ref, 'say', hall.say(ref, text, steering.spoken.value));
    steering.words.value = steering.spoken.value = ''; // the language applies to one speech
  };
  return (
    <section class="visitors-orders" aria-label={ref}>
      <h2>{ref}</h2>
      {places.length > 0 && (
        <Form class="visitors-row" submit={() => void steering.order(ref, 'walk', hall.walk(ref, place))}>
          <SelectField
            label={texts.walk_to()}
            value={place}
            change={(to) => (steering.place.value = to)}
            choices={places.map((one) => ({ value: one, label: one.replaceAll('_', ' ') }))}
          />
          <Button type="submit" icon="right">
            {texts.go()}
          </Button>
        </Form>
      )}
      <Form class="visitors-row visitors-saying" submit={say}>
        <TextField
          label={texts.say()}
          value={steering.words.value}
          change={(to) => (steering.words.value = to)}
          input={{ placeholder: texts.say_hint(), enterkeyhint: 'send' }}
        />
        <SelectField
          label={texts.language()}
          value={steering.spoken.value}
          change={(to) => (steering.spoken.value = to)}
          choices={[{ value: '', label: texts.own_language() }, ...languages.map((one) => ({ value: one as string, label: one }))]}
        />
        <Button type="submit" icon="messages" disabled={steering.words.value.trim() === ''}>{texts.speak()}</Button>
      </Form>
      <div class="visitors-gestures" role="group" aria-label={texts.gestures()}>
        {gestures.map((one) => (
          <Button key={one} small onClick={() => void steering.order(ref, 'gesture', hall.gesture(ref, one))}>{texts.gesture(one)}</Button>
        ))}
      </div>
      <div>
        <Button small look="danger" onClick={() => void steering.order(ref, 'leave', hall.leave(ref))}>{texts.leave()}</Button>
      </div>
    </section>
  );
}

const spans = [100, 1000, 10_000]; // ms

function Time({ steering }: { steering: Steering }) {
  const flows = steering.flows.value;
  const { is_open } = useConsole().link;
  return (
    <section class="visitors-time" aria-label={texts.time()}>
      <p title={texts.stands_still_hint()}>{texts.stands_still()}</p>
      {spans.map((ms) => (
        <Button
          key={ms}
          small
          disabled={flows || !is_open}
          aria-label={texts.pass_label(ms / 1000)}
          onClick={() => void steering.pass(ms)}
        >{`+ ${texts.pass(String(ms / 1000))}`}</Button>
      ))}
      <Button
        small
        icon={flows ? 'pause' : 'play'}
        aria-pressed={flows}
        disabled={!flows && !is_open}
        onClick={() => (flows ? steering.halt() : void steering.flow())}
      >
        {flows ? texts.halt() : texts.flow()}
      </Button>
    </section>
  );
}
