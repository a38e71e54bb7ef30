// The Events tab: a form for each event of a component, its subscriptions and the latest events.
import { component_ref, Condition, condition_xml, parse_xml, request, text_element } from 'rois-client';

import { useConsole } from '../context';
import { Exchange, useDraft } from '../forms';
import { clock_time } from '../i18n/i18n';
import { reason_of } from '../state/base/reason_of';
import type { ComponentView, Offered } from '../state/engine/profile_state';
import { Button, Checkbox, Form, TextArea, tried } from '../ui';
import { Pick } from './pick';
import * as texts from './texts';

const most_shown = 8;

export function EventsTab({ view }: { view: ComponentView }) {
  const names = view.events.map((one) => one.name);
  const [name, choose] = useDraft(`${view.ref} event`, names[0] ?? '');
  const event = view.events.find((one) => one.name === name);
  if (!event) return <p>{texts.no_events()}</p>;
  return (
    <>
      <Pick label={texts.choose_event()} names={names} offered={view.events} chosen={name} choose={choose} />
      <SubscribeForm key={name} view={view} event={event} />
      <Subscriptions event_type={name} />
      <LastEvents view={view} event_type={name} />
    </>
  );
}

function SubscribeForm({ view, event }: { view: ComponentView; event: Offered }) {
  const console = useConsole();
  const key = `${view.ref} ${event.name}`;
  const [only_mine, set_only_mine] = useDraft(`${key} only`, true);
  const [inline_results, set_inline] = useDraft(`${key} inline`, true);
  const [further, set_further] = useDraft(`${key} condition`, '');
  const bad = further.trim() === '' ? '' : what_is_wrong(further);
  const condition = joined(only_mine ? component_ref(view.ref) : undefined, bad === '' ? further.trim() : '');
  const results = event.results.map((one) => `${one.name} (${one.data_type_ref.code})`).join(', ');
  return (
    <Form class="component-form">
      <p class="soft">{results !== '' && texts.brings(results)} {texts.not_started()}</p>
      <div class="component-line">
        <Checkbox label={texts.only_mine(view.ref)} checked={only_mine} change={set_only_mine} />
        <Checkbox label={texts.inline()} checked={inline_results} change={set_inline} />
      </div>
      <TextArea
        label={texts.condition()}
        value={further}
        change={set_further}
        rows={2}
        error={bad === '' ? '' : texts.condition_bad(bad)}
      />
      <Exchange
        title={`${view.ref} ${event.name}`}
        operation="subscribe"
        label={texts.subscribe()}
        icon="plus"
        request={request('subscribe', { inline_results }, text_element('event_type', event.name) + condition_xml(condition))}
        may_send={() => bad === ''}
        act={() => console.subscribe(event.name, { inline_results, ...(condition && { condition }) })}
      />
    </Form>
  );
}

// Both conditions must hold. The typed one may have a filter element around it or not.
function joined(chosen: Condition | undefined, further: string): Condition | undefined {
  if (further === '') return chosen;
  const inside = /^<fes:Filter(?:\s[^>]*)?>([^]*)<\/fes:Filter>$/.exec(further)?.[1] ?? further;
  const typed = new Condition(inside);
  return chosen ? chosen.and(typed) : typed;
}

function what_is_wrong(xml: string): string {
  try {
    parse_xml(`<c xmlns:fes="f" xmlns:gml="g" xmlns:unr="u" xmlns:rois="r" xmlns:xsi="x">${xml}</c>`);
    return '';
  } catch (error) {
    return reason_of(error);
  }
}

function Subscriptions({ event_type }: { event_type: string }) {
  const console = useConsole();
  const { subscriptions, events } = console;
  void events.pulse.beat.value; // counts change in place
  const entries = [...subscriptions.all.value.values()].filter((one) => one.event_type === event_type && !subscriptions.is_own(one.id));
  if (entries.length === 0) return null;
  const leave = (id: string) => tried(console, id, subscriptions.unsubscribe(id));
  return (
    <>
      <h3>{texts.subscriptions()}</h3>
      <ul class="component-list">
        {entries.map((one) => (
          <li key={one.id} class="row-spread">
            <span>
              <code>{one.id}</code> <span class="soft">{clock_time(one.since, false)} · {texts.counted(one.count)}</span>
            </span>
            <Button small aria-label={texts.unsubscribe_it(one.id)} onClick={() => leave(one.id)}>
              {texts.unsubscribe()}
            </Button>
          </li>
        ))}
      </ul>
    </>
  );
}

function LastEvents({ view, event_type }: { view: ComponentView; event_type: string }) {
  const { events } = useConsole();
  void events.pulse.beat.value;
  const last = [];
  for (let i = 1; i <= events.events.size && last.length < most_shown; ++i) {
    const one = events.events.at(-i)!;
    if (one.event.event_type === event_type && one.event.component_ref.code === view.ref) last.push(one);
  }
  if (last.length === 0) return null;
  return (
    <>
      <h3>{texts.last_events()}</h3>
      <ul class="component-list">
        {last.map((one) => (
          <li key={one.number}>
            <span class="soft">{clock_time(one.at)}</span>{' '}
            {one.details.state === 'there' &&
              one.details.results.parameters
                .filter((each) => each.name !== 'timestamp')
                .map((each) => `${each.name}: ${each.values.join('; ')}`)
                .join(' · ')}
          </li>
        ))}
      </ul>
    </>
  );
}
