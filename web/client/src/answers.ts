// Reads the engine's answers and notifications into objects.
import { type CompletedStatus, type ErrorType, type Fault, type ReturnCode, RoisError } from './errors.js';
import type { Notification, StopState } from './messages.js';
import type { ComponentProfile, EngineProfile, MessageProfile, ParameterProfile, Profile } from './profiles.js';
import { namespaces } from './requests.js';
import { type Identifier, type Located, type Parameter, Results } from './values.js';
import type { XmlElement } from './xml.js';

const { rois, gml, xsi } = namespaces;

function broken(what: string): RoisError {
  return new RoisError('protocol', `invalid document from the engine: ${what}`);
}

function needed(from: XmlElement, name: string): XmlElement {
  return from.child(name) ?? raise(`'${from.name}' has no '${name}'`);
}

function needed_attribute(from: XmlElement, name: string, namespace = ''): string {
  return from.attribute(name, namespace) ?? raise(`'${from.name}' has no attribute '${name}'`);
}

function raise(what: string): never {
  throw broken(what);
}

// A copy without the undefined properties.
function present<T extends object>(all: { [Key in keyof T]: T[Key] | undefined }): T {
  return Object.fromEntries(Object.entries(all).filter(([, one]) => one !== undefined)) as T;
}

/** The error in a failed answer; undefined if it is OK. */
export function trouble_of(answer: XmlElement): RoisError | undefined {
  if (answer.name === 'fault') {
    const fault = fault_of(answer);
    return new RoisError('fault', `${fault.code}: ${fault.reason}`, { fault });
  }
  const code = needed_attribute(answer, 'return_code') as ReturnCode;
  if (code === 'OK') return undefined;
  const operation = answer.name.replace(/_response$/, '');
  return new RoisError('refused', `${operation}: ${code}: ${answer.text_of('reason')}`, { return_code: code });
}

export function fault_of(document: XmlElement): Fault {
  const number = (name: string) => (document.attribute(name) === undefined ? undefined : Number(document.attribute(name)));
  return present<Fault>({
    code: needed_attribute(document, 'code'),
    reason: document.text_of('reason'),
    line: number('line'),
    column: number('column'),
  });
}

export function identifier_of(from: XmlElement): Identifier {
  return present<Identifier>({
    code: needed_attribute(from, 'code', rois),
    authority: from.attribute('authority', rois),
    codebook_ref: from.attribute('codebook_ref', rois),
    version: from.attribute('version', rois),
  });
}

export function component_ref_of(answer: XmlElement): Identifier {
  return identifier_of(needed(answer, 'component_ref'));
}

export function parameter_of(from: XmlElement): Parameter {
  return {
    name: needed_attribute(from, 'name', rois),
    data_type_ref: identifier_of(needed(from, 'data_type_ref')),
    values: from.all('value').map((one) => one.text),
  };
}

/** The results in an answer or an event; empty if it has none. */
export function results_of(answer: XmlElement): Results {
  const results = answer.child('results');
  if (results === undefined) return new Results();
  return new Results(results.all('result').map(parameter_of), results.all('located').map(located_of));
}

function numbers_in(text: string): number[] {
  return text.split(/\s+/).filter((item) => item !== '').map(Number);
}

function located_of(from: XmlElement): Located {
  const three = (name: string) => numbers_in(needed(from, name).text) as [number, number, number];
  return present<Located>({
    of: needed_attribute(from, 'of'),
    ref: needed_attribute(from, 'ref'),
    crs: needed_attribute(from, 'crs'),
    position: three('position'),
    orientation: from.child('orientation') && three('orientation'),
    reliability: from.child('reliability') && Number(from.text_of('reliability')),
    covariance: from.child('covariance') && numbers_in(from.text_of('covariance')),
  });
}

const notification_names = ['receive_event', 'receive_error', 'completed', 'lost', 'profile_changed', 'switched'];

export function is_notification(document: XmlElement): boolean {
  return notification_names.includes(document.name);
}

/** Throws RoisError `protocol` if the document is not a notification. */
export function notification_of(document: XmlElement): Notification {
  const sequence = Number(needed_attribute(document, 'sequence'));
  const text = (name: string) => needed(document, name).text;
  switch (document.name) {
    case 'receive_event':
      return {
        name: 'receive_event',
        sequence,
        event_id: text('event_id'),
        event_type: text('event_type'),
        subscribe_id: text('subscribe_id'),
        expire: new Date(text('expire')),
        component_ref: component_ref_of(document),
        results: results_of(document),
      };
    case 'receive_error': {
      const of = document.child('component_ref');
      const error = { name: 'receive_error' as const, sequence, error_id: text('error_id'), error_type: text('error_type') as ErrorType };
      return of === undefined ? error : { ...error, component_ref: identifier_of(of) };
    }
    case 'completed':
      return { name: 'completed', sequence, command_id: text('command_id'), status: text('status') as CompletedStatus };
    case 'lost':
      return { name: 'lost', sequence, count: Number(needed_attribute(document, 'count')) };
    case 'profile_changed':
      return { name: 'profile_changed', sequence };
    case 'switched':
      return {
        name: 'switched',
        sequence,
        component_ref: component_ref_of(document),
        from: text('from'),
        to: text('to'),
        reason: text('reason'),
      };
    default:
      throw broken(`'${document.name}' is not a notification`);
  }
}

/** Throws RoisError `protocol` for another document. */
export function stop_state_of(document: XmlElement): StopState {
  if (document.name !== 'stop_state') throw broken(`'${document.name}' is not a stop_state`);
  const stopped = needed(document, 'stopped').text.trim();
  return { stopped: stopped === 'true' || stopped === '1', not_halted: document.all('not_halted').map((one) => one.text) };
}

export function profile_of(answer: XmlElement): Profile {
  return {
    engine: engine_profile_of(needed(answer, 'HRIEngineProfile')),
    components: needed(answer, 'components').all('component').map((one) => ({
      ref: needed_attribute(one, 'ref'),
      type: needed_attribute(one, 'type'),
      engine: needed_attribute(one, 'engine'),
    })),
    component_profiles: answer.all('HRIComponentProfile').map(component_profile_of),
  };
}

export function engine_profile_of(from: XmlElement): EngineProfile {
  return {
    id: needed_attribute(from, 'id', gml),
    identifier: from.text_of('identifier'),
    name: from.text_of('name'),
    sub_engines: from.all('SubProfile').map(engine_profile_of),
    components: from.all('HRIComponent').map((one) => one.text),
    parameters: from.all('ParameterProfile').map(parameter_profile_of),
  };
}

export function component_profile_of(from: XmlElement): ComponentProfile {
  return {
    id: needed_attribute(from, 'id', gml),
    identifier: from.text_of('identifier'),
    name: from.text_of('name'),
    description: from.text_of('description'),
    sub_profiles: from.all('SubComponentProfile').map((one) => one.text),
    messages: from.all('MessageProfile').map(message_profile_of),
    parameters: from.all('ParameterProfile').map(parameter_profile_of),
  };
}

function message_profile_of(from: XmlElement): MessageProfile {
  const kind = /:?(Command|Query|Event)MessageProfileType$/.exec(from.attribute('type', xsi) ?? '')?.[1]?.toLowerCase();
  const timeout = from.attribute('timeout', rois);
  return present<MessageProfile>({
    kind: (kind ?? raise('a MessageProfile has no type')) as MessageProfile['kind'],
    name: needed_attribute(from, 'name', rois),
    results: from.all('Results').map(parameter_profile_of),
    arguments: from.all('Arguments').map(parameter_profile_of),
    timeout: timeout === undefined ? undefined : Number(timeout),
  });
}

function parameter_profile_of(from: XmlElement): ParameterProfile {
  return present<ParameterProfile>({
    name: needed_attribute(from, 'name', rois),
    data_type_ref: identifier_of(needed(from, 'data_type_ref')),
    default_value: from.attribute('default_value', rois),
    description: from.attribute('description', rois),
  });
}
