// The subscriptions made here and their latest events.
import type { Subscription } from 'rois-client';

import { useConsole } from '../context';
import { duration } from '../i18n/i18n';
import { show_events } from '../shell/navigation';
import { Badge, Button, Icon, tried } from '../ui';
import type { ConditionStore } from './store';
import * as texts from './texts';

export function Subscriptions({ store }: { store: ConditionStore }) {
  const console = useConsole();
  const { subscriptions, events, now } = console;
  void events.pulse.beat.value;
  const all = subscriptions.all.value;
  const own = store.subscribed.value.filter((one) => all.has(one.subscribe_id));
  if (own.length === 0) return null;
  return (
    <div class="conditions-subscriptions">
      <h3>{texts.subscriptions()}</h3>
      <ul class="plain-list">
        {own.map((one) => {
          const entry = all.get(one.subscribe_id)!;
          return (
            <li key={one.subscribe_id} class="conditions-subscription">
              <div class="row-spread">
                <span class="row">
                  <strong>{entry.event_type}</strong>
                  {entry.count === 0 ? (
                    <Badge>{texts.events(0)}</Badge>
                  ) : (
                    <Button small onClick={() => show_events(console, one.subscribe_id)}>
                      {texts.events(entry.count)}
                    </Button>
                  )}
                  {entry.last_at !== undefined && <span class="field-hint">{texts.last(duration(now.value - entry.last_at))}</span>}
                </span>
                <Button small onClick={() => void store.unsubscribe(one)}>
                  {texts.unsubscribe()}
                </Button>
              </div>
              <p class="conditions-said">{said_by(entry.condition) || texts.no_condition()}</p>
              {entry.count === 0 && <StartHint subscription={one} />}
            </li>
          );
        })}
      </ul>
    </div>
  );
}

// A component sends events only after it has been started.
function StartHint({ subscription }: { subscription: Subscription }) {
  const console = useConsole();
  void console.commands.pulse.beat.value;
  const senders = console.profile
    .with_event(subscription.wanted.event_type)
    .filter((one) => one.commands.some(({ name }) => name === 'start'));
  if (senders.length === 0) return null;
  const started = new Set(
    console.commands.all
      .list()
      .filter((one) => one.command_type === 'start' && one.state === 'OK')
      .map((one) => one.component),
  );
  const start = (ref: string) => tried(console, ref, console.run(ref, 'start'));
  return (
    <div class="conditions-start">
      <p>
        <Icon name="info" /> {texts.start_first()}
      </p>
      <div class="conditions-chips">
        {senders.map(({ ref }) =>
          started.has(ref) ? (
            <Badge key={ref} tone="good">
              {texts.started(ref)}
            </Badge>
          ) : (
            <Button key={ref} small icon="play" onClick={() => void start(ref)}>
              {texts.start(ref)}
            </Button>
          ),
        )}
      </div>
    </div>
  );
}

const operators = /^(PropertyIs|Within|DWithin|Beyond|Disjoint|Intersects|BBOX|During|After|Before|Not|Or)/;

// The operators and texts of a condition without markup, as a summary.
function said_by(condition: string): string {
  const plain = condition.replace(/<(\/?)(?:[\w.-]+:)?([\w.-]+)[^>]*>/g, (_, end: string, name: string) =>
    end === '' && operators.test(name) ? ` ${name.replace('PropertyIs', '')} ` : ' ',
  );
  return plain.replace(/\s+/g, ' ').trim();
}
