// The engine's profile, with included component profiles resolved.
import { computed, signal } from '@preact/signals';
import type { ComponentEntry, ComponentProfile, EngineProfile, MessageProfile, ParameterProfile, Profile } from 'rois-client';

/** A message with the name of its profile. */
export interface Offered extends MessageProfile {
  from: string;
}

/** A component with all its messages and parameters; included profiles first. */
export interface ComponentView {
  ref: string;
  type: string; // URN
  type_name: string; // last part of the URN: `Navigation`
  engine: string;
  description: string;
  includes: string[]; // URNs
  unresolved: string[]; // URNs of included profiles that the engine has not sent
  commands: Offered[]; // commands of `execute`, without set_parameter
  queries: Offered[]; // without get_parameter and set_parameter
  events: Offered[];
  parameters: ParameterProfile[];
  profile?: ComponentProfile;
}

/** An engine, its components and its sub engines. */
export interface EngineView {
  name: string;
  identifier: string;
  components: ComponentView[];
  sub_engines: EngineView[];
}

const common = 'urn:x-rois:def:component:OMG::RoISCommon';

// Table 32. Engine profiles refer to RoIS_Common without defining it.
const own_profiles: ComponentProfile[] = [
  {
    id: 'profile.RoIS_Common',
    identifier: common,
    name: 'RoIS_Common',
    description: '',
    sub_profiles: [],
    parameters: [],
    messages: [
      ...['start', 'stop', 'suspend', 'resume'].map((name): MessageProfile => ({ kind: 'command', name, results: [], arguments: [] })),
      {
        kind: 'query',
        name: 'component_status',
        arguments: [],
        results: [{ name: 'status', data_type_ref: { code: 'Component_Status' } }],
      },
    ],
  },
];

export class ProfileState {
  /** The latest profile; undefined before the first. */
  readonly profile = signal<Profile | undefined>(undefined);
  readonly reported_at = signal(0);
  readonly components = computed<readonly ComponentView[]>(() => (this.profile.value ? views_of(this.profile.value) : []));
  readonly by_ref = computed<ReadonlyMap<string, ComponentView>>(() => new Map(this.components.value.map((one) => [one.ref, one])));
  readonly engine = computed<EngineView | undefined>(() => {
    const profile = this.profile.value;
    return profile && engine_view(profile.engine, this.components.value);
  });
  /** Whether the engine is known to have no components. */
  readonly is_empty = computed(() => this.profile.value !== undefined && this.components.value.length === 0);

  component(ref: string): ComponentView | undefined {
    return this.by_ref.value.get(ref);
  }

  /** Whether a component works on after `start` has completed: it detects, localizes, identifies, recognizes or streams. */
  lasts(ref: string): boolean {
    const view = this.component(ref);
    return (
      view !== undefined &&
      [view.type, ...view.includes].some((urn) => /(Detection|Localization|Identification|Recognition|Streaming)$/i.test(urn))
    );
  }

  /** Components of a type, by URN or its last part, case-insensitive. Included profiles count. */
  of_type(type: string): ComponentView[] {
    const is_it = (urn: string) => urn.toLowerCase() === type.toLowerCase() || type_name(urn).toLowerCase() === type.toLowerCase();
    return this.components.value.filter((one) => is_it(one.type) || one.includes.some(is_it));
  }

  /** Components with an event of this name. */
  with_event(event_type: string): ComponentView[] {
    return this.components.value.filter((one) => one.events.some((event) => event.name === event_type));
  }

  /** Components with a query of this name. */
  with_query(query_type: string): ComponentView[] {
    return this.components.value.filter((one) => one.queries.some((query) => query.name === query_type));
  }

  update(profile: Profile, at: number): void {
    this.profile.value = profile;
    this.reported_at.value = at;
  }
}

/** `Navigation` for `urn:x-rois:def:component:OMG::Navigation`. */
function type_name(urn: string): string {
  return urn.slice(urn.lastIndexOf(':') + 1);
}

export function views_of(profile: Profile): ComponentView[] {
  const known = new Map([...own_profiles, ...profile.component_profiles].map((one) => [one.identifier.toLowerCase(), one]));
  const by_id = new Map(profile.component_profiles.map((one) => [one.id, one]));
  return profile.components
    .map((entry) => view_of(entry, by_id.get(`profile.${entry.ref}`) ?? known.get(entry.type.toLowerCase()), known))
    .sort((a, b) => a.ref.localeCompare(b.ref, 'en'));
}

function view_of(entry: ComponentEntry, profile: ComponentProfile | undefined, known: Map<string, ComponentProfile>): ComponentView {
  const { all, missing } = with_included(profile, known);
  const messages = unique(all.flatMap((one) => one.messages.map((message): Offered => ({ ...message, from: one.name }))));
  const of_kind = (kind: MessageProfile['kind']) =>
    messages.filter((one) => one.kind === kind && one.name !== 'set_parameter' && one.name !== 'get_parameter');
  const view: ComponentView = {
    ref: entry.ref,
    type: entry.type,
    type_name: type_name(entry.type),
    engine: entry.engine,
    description: profile?.description ?? '',
    includes: all.slice(1).map((one) => one.identifier),
    unresolved: missing,
    commands: of_kind('command'),
    queries: of_kind('query'),
    events: of_kind('event'),
    parameters: unique([...all.flatMap((one) => one.parameters), ...all.flatMap(set_by_message)]),
  };
  if (profile) view.profile = profile;
  return view;
}

// Parameters that only the message's profile declares.
function set_by_message(profile: ComponentProfile): ParameterProfile[] {
  return profile.messages.filter((one) => one.kind === 'command' && one.name === 'set_parameter').flatMap((one) => one.arguments);
}

// The profile and all that it includes, each once.
function with_included(profile: ComponentProfile | undefined, known: Map<string, ComponentProfile>) {
  const all = profile ? [profile] : [];
  const missing: string[] = [];
  for (let i = 0; i < all.length; ++i)
    for (const urn of all[i]!.sub_profiles) {
      const included = known.get(urn.toLowerCase());
      if (included === undefined) missing.push(urn);
      else if (!all.includes(included)) all.push(included);
    }
  return { all, missing };
}

// Names are case-insensitive; the first of a name counts.
function unique<T extends { name: string; kind?: string }>(list: T[]): T[] {
  const seen = new Set<string>();
  return list.filter((one) => {
    const key = `${one.kind ?? ''} ${one.name.toLowerCase()}`;
    return !seen.has(key) && seen.add(key);
  });
}

function engine_view(engine: EngineProfile, components: readonly ComponentView[]): EngineView {
  return {
    name: engine.name,
    identifier: engine.identifier,
    components: components.filter((one) => one.engine === engine.name),
    sub_engines: engine.sub_engines.map((sub) => engine_view(sub, components)),
  };
}
