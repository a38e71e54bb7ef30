// The grammar of scenarios: schemas/scenario.xsd as tables, for validation and forms.

/** `variable`, `component`, `state`: an existing name; `result`: a name of the engine; `text` may have {name}. */
export type AttributeType =
  | 'name'
  | 'variable'
  | 'component'
  | 'state'
  | 'result'
  | 'text'
  | 'token'
  | 'plain'
  | 'status'
  | 'switching'
  | 'boolean'
  | 'double'
  | 'natural';

export interface AttributeRule {
  type: AttributeType;
  required: boolean;
}

/** The allowed number of these elements, in any order. */
export interface Group {
  names: readonly string[];
  least: number;
  most: number;
}

export interface ElementRule {
  attributes: Readonly<Record<string, AttributeRule>>;
  /** Groups in this order. */
  content: readonly Group[];
  /** Whether it has text: with {name} or plain. */
  text?: 'text' | 'plain';
}

export const namespace = 'urn:x-rois:scenario:1';
export const statuses = ['OK', 'ERROR', 'ABORT', 'OUT_OF_RESOURCES', 'TIMEOUT'] as const;
export const switchings = ['none', 'abort', 'restart'] as const;

const needed = (type: AttributeType): AttributeRule => ({ type, required: true });
const optional = (type: AttributeType): AttributeRule => ({ type, required: false });
const any = (...names: string[]): Group => ({ names, least: 0, most: Infinity });
const at_most_one = (...names: string[]): Group => ({ names, least: 0, most: 1 });
const some = (...names: string[]): Group => ({ names, least: 1, most: Infinity });

export const actions = ['set', 'add', 'count', 'place', 'print'] as const;
export const steps = ['take', 'when', ...actions] as const;
export const triggers = ['event', 'completed', 'answered', 'after', 'at_once'] as const;

const trigger = (attributes: Record<string, AttributeRule>): ElementRule => ({
  attributes: { ...attributes, to: needed('state') },
  content: [any(...steps)],
});
const assignment: ElementRule = { attributes: { variable: needed('variable') }, content: [], text: 'text' };

const rules: Readonly<Record<string, ElementRule>> = {
  robot_scenario: {
    attributes: { name: optional('plain'), start: needed('state') },
    content: [some('component'), any('variable'), some('state', 'end')],
  },
  component: {
    attributes: { name: needed('name'), ref: optional('token'), type: optional('token'), switching: optional('switching') },
    content: [],
  },
  variable: { attributes: { name: needed('name') }, content: [], text: 'plain' },
  state: {
    attributes: { name: needed('name') },
    content: [any(...actions), any('command'), at_most_one('query'), any(...triggers), at_most_one('leaving')],
  },
  end: { attributes: { name: needed('name'), failed: optional('boolean') }, content: [any(...actions)] },
  command: {
    attributes: { component: needed('component'), type: needed('result'), delay: optional('natural') },
    content: [any('argument')],
  },
  argument: { attributes: { name: needed('result') }, content: [], text: 'text' },
  query: { attributes: { type: needed('result'), component: optional('component') }, content: [] },
  leaving: { attributes: {}, content: [some('command')] },
  event: trigger({ type: needed('result'), component: optional('component') }),
  completed: trigger({ status: optional('status') }),
  answered: trigger({}),
  after: trigger({ seconds: needed('text') }),
  at_once: trigger({}),
  set: assignment,
  add: assignment,
  count: { attributes: { variable: needed('variable') }, content: [] },
  place: {
    attributes: { variable: needed('variable'), before: needed('text'), distance: needed('double'), turn: optional('double') },
    content: [],
  },
  print: { attributes: {}, content: [], text: 'text' },
  take: {
    attributes: {
      variable: needed('variable'),
      result: needed('result'),
      not_in: optional('variable'),
      apart: optional('double'),
      beside: optional('result'),
      is: optional('text'),
    },
    content: [],
  },
  when: {
    attributes: {
      variable: needed('variable'), is: optional('text'), is_not: optional('text'), in: optional('variable'), not_in: optional('variable'),
      empty: optional('boolean'), near: optional('text'), within: optional('double'),
    },
    content: [],
  },
};

export function rule_of(name: string): ElementRule | undefined {
  return Object.hasOwn(rules, name) ? rules[name] : undefined;
}

const a_name = /^[A-Za-z_][A-Za-z0-9_.-]*$/;
const a_double = /^[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?$|^-?INF$|^NaN$/;

/** Whether a value has the right form; the named thing may still be missing. */
export function is_of(type: AttributeType, value: string): boolean {
  const text = value.trim();
  switch (type) {
    case 'name':
    case 'variable':
    case 'component':
    case 'state':
    case 'result':
      return a_name.test(text);
    case 'status':
      return (statuses as readonly string[]).includes(text);
    case 'switching':
      return (switchings as readonly string[]).includes(text);
    case 'boolean':
      return /^(true|false|1|0)$/.test(text);
    case 'double':
      return a_double.test(text);
    case 'natural':
      return /^\+?\d+$/.test(text) && Number(text) <= 0xffff_ffff;
    default:
      return true;
  }
}

/** The whole text as a number, or undefined. */
export function to_double(text: string): number | undefined {
  const trimmed = text.trim();
  if (!a_double.test(trimmed)) return undefined;
  return Number(trimmed.replace('INF', 'Infinity'));
}
