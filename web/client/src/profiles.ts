// Profiles (7.5, tables 24 to 30): the capabilities of an engine and its components.
import type { Identifier } from './values.js';

/** ParameterProfile: a parameter, argument or result. */
export interface ParameterProfile {
  name: string;
  data_type_ref: Identifier;
  default_value?: string;
  description?: string;
}

/** MessageProfile: a command, query or event. */
export interface MessageProfile {
  kind: 'command' | 'query' | 'event';
  name: string;
  results: ParameterProfile[];
  arguments: ParameterProfile[]; // of a command
  timeout?: number; // of a command: ms within which the component must start
}

/** HRIComponentProfile. */
export interface ComponentProfile {
  id: string; // gml:id: `profile.` and the component's ref
  identifier: string; // URN of the component type
  name: string;
  description: string;
  sub_profiles: string[]; // URNs of included profiles
  messages: MessageProfile[];
  parameters: ParameterProfile[];
}

/** HRIEngineProfile. */
export interface EngineProfile {
  id: string; // gml:id: `engine.` and its name
  identifier: string;
  name: string;
  sub_engines: EngineProfile[];
  components: string[]; // refs
  parameters: ParameterProfile[];
}

/** A component as `get_profile` lists it. */
export interface ComponentEntry {
  ref: string;
  type: string; // URN of its profile
  engine: string; // its engine or sub engine
}

/** The result of `get_profile`. */
export interface Profile {
  engine: EngineProfile;
  components: ComponentEntry[];
  component_profiles: ComponentProfile[];
}
