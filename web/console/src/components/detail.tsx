// A component: status, owner and messages.
import { useConsole } from '../context';
import { shown_description, useDraft } from '../forms';
import type { ComponentView } from '../state/engine/profile_state';
import { Badge, Button, StatusBadge, Tabs, tried } from '../ui';
import { CommandsTab } from './commands_tab';
import { EventsTab } from './events_tab';
import { holder_text } from './holder';
import { ParametersTab } from './parameters_tab';
import { QueriesTab, query_names } from './queries_tab';
import * as texts from './texts';
import { Work } from './work';

type Part = 'commands' | 'parameters' | 'queries' | 'events';

export function Detail({ view }: { view: ComponentView }) {
  const console = useConsole();
  const [part, set_part] = useDraft<Part>('part', 'commands');
  const count = (n: number) => (n === 0 ? undefined : String(n));
  const tabs = [
    { id: 'commands' as const, title: texts.commands(), badge: count(view.commands.length) },
    {
      id: 'parameters' as const,
      title: texts.parameters(),
      badge: count(console.parameters.of(view.ref)?.parameters.length ?? view.parameters.length),
    },
    { id: 'queries' as const, title: texts.queries(), badge: count(query_names(view).length) },
    { id: 'events' as const, title: texts.events(), badge: count(view.events.length) },
  ];
  return (
    <section class="component-detail" aria-label={view.ref}>
      <Head view={view} />
      <div class="component-parts">
        <Tabs label={texts.of_component(view.ref)} tabs={tabs} chosen={part} choose={set_part}>
          <div class="component-part" key={part}>
            {part === 'commands' && <CommandsTab view={view} />}
            {part === 'parameters' && <ParametersTab view={view} />}
            {part === 'queries' && <QueriesTab view={view} />}
            {part === 'events' && <EventsTab view={view} />}
          </div>
        </Tabs>
      </div>
    </section>
  );
}

// The members of a logical component. Several may act for one that senses.
function Members({ component }: { component: string }) {
  const { members } = useConsole();
  const acting = members.acting_for(component);
  if (members.of(component).length === 0) return null;
  return (
    <ul class="component-members" aria-label={texts.members()}>
      {members.of(component).map((ref) => (
        <li key={ref}>
          <code>{ref}</code> {acting.includes(ref) && <Badge tone="good">{texts.acts()}</Badge>}
        </li>
      ))}
    </ul>
  );
}

function Head({ view }: { view: ComponentView }) {
  const console = useConsole();
  const { status, bindings, now, link } = console;
  const entry = status.of(view.ref);
  const is_mine = bindings.mine.value.has(view.ref);
  return (
    <header class="component-head">
      <div class="component-line">
        <h2>{view.ref}</h2>
        {entry && <StatusBadge status={entry.status} title={entry.trouble} />}
        <Work component={view.ref} />
        {entry && <span class="soft">{texts.since(Math.max(0, now.value - entry.since))}</span>}
        <span class="component-holder">{holder_text(console, view.ref) || texts.nobody()}</span>
        <Button
          small
          disabled={!link.is_open}
          aria-label={is_mine ? texts.release_it(view.ref) : texts.bind_it(view.ref)}
          onClick={() => tried(console, view.ref, is_mine ? bindings.release(view.ref) : bindings.bind(view.ref))}
        >
          {is_mine ? texts.release() : texts.bind()}
        </Button>
      </div>
      <Members component={view.ref} />
      {view.description !== '' && <p>{shown_description(view.description)}</p>}
      <p class="soft"><code>{view.type}</code></p>
      {view.unresolved.length > 0 && <p class="soft">{texts.unresolved(view.unresolved.join(', '))}</p>}
    </header>
  );
}
