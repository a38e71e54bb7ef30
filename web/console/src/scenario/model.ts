// A robot scenario (figure 1), ready to run.
import type { CompletedStatus, Switching } from 'rois-client';

import type { Node } from './source';

export type Step =
  | { kind: 'set' | 'add'; variable: string; text: string }
  | { kind: 'count'; variable: string }
  | { kind: 'place'; variable: string; before: string; distance: number; turn: number } // mm, degrees
  | { kind: 'print'; text: string }
  | TakeResult
  | When;

export interface TakeResult {
  kind: 'take';
  variable: string;
  result: string;
  not_in: string; // a variable; empty: any value
  beside: string; // another result; empty: none
  is: string;
  apart: number; // mm; if above 0, the list has places
}

export type Relation = 'is' | 'is_not' | 'in' | 'not_in' | 'empty' | 'not_empty' | 'near';

export interface When {
  kind: 'when';
  variable: string;
  relation: Relation;
  operand: string;
  within: number; // mm
}

export interface ScenarioCommand {
  component: string; // the scenario's name
  type: string;
  arguments: { name: string; text: string }[];
  delay?: number; // ms
  node: Node;
}

export type TriggerKind = 'event' | 'completed' | 'answered' | 'after' | 'at_once';

export interface Trigger {
  kind: TriggerKind;
  event_type: string;
  component: string; // empty: any
  status?: CompletedStatus; // undefined: any
  seconds: string;
  steps: Step[];
  to: string;
  node: Node;
}

export interface State {
  name: string;
  steps: Step[];
  commands: ScenarioCommand[];
  query?: { type: string; component: string; node: Node }; // component empty: any
  triggers: Trigger[];
  leaving: ScenarioCommand[];
  is_end: boolean;
  failed: boolean;
  node: Node;
}

export interface Scenario {
  name: string;
  start: string;
  components: { name: string; ref: string; type: string; switching?: Switching; node: Node }[]; // ref empty: any of the type
  variables: Map<string, string>;
  states: Map<string, State>;
  root: Node;
}
