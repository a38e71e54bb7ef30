// Writes requests as XML documents.
import type { CommandMessage, CommandUnit } from './commands.js';
import type { Parameter, Ref } from './values.js';
import { element, text_element } from './xml.js';

export const namespaces = {
  message: 'urn:x-rois:psm:xml:message:1',
  rois: 'http://www.omg.org/spec/RoIS/20240801',
  fes: 'http://www.opengis.net/fes/2.0',
  gml: 'http://www.opengis.net/gml/3.2',
  unr: 'http://www.irc.atr.jp/std/unr/0.1',
  xsi: 'http://www.w3.org/2001/XMLSchema-instance',
};

/** Every operation of the RoIS interfaces (tables 2 to 5), and `resume`. */
export type Operation =
  | 'connect'
  | 'resume'
  | 'disconnect'
  | 'get_profile'
  | 'get_error_detail'
  | 'search'
  | 'bind'
  | 'bind_any'
  | 'release'
  | 'get_parameter'
  | 'set_parameter'
  | 'execute'
  | 'get_command_result'
  | 'query'
  | 'subscribe'
  | 'unsubscribe'
  | 'get_event_detail';

/** A condition: of `conditions.ts`, or any object with XML. */
export interface Writable {
  readonly xml: string;
}

/** A request document. Declares the prefixes that `content` uses. */
export function request(operation: Operation, attributes: Record<string, string | number | boolean | undefined>, content = ''): string {
  const declared: Record<string, string> = { xmlns: namespaces.message };
  for (const prefix of ['rois', 'fes', 'gml', 'unr', 'xsi'] as const)
    if (content.includes(`${prefix}:`)) declared[`xmlns:${prefix}`] = namespaces[prefix];
  return element(operation, { ...declared, ...attributes }, content);
}

export function condition_xml(condition: Writable | undefined): string {
  return condition === undefined || condition.xml === '' ? '' : element('condition', {}, condition.xml);
}

export function component_ref_xml(ref: Ref, name = 'component_ref'): string {
  const { authority, code, codebook_ref, version } = typeof ref === 'string' ? ({ code: ref } as Exclude<Ref, string>) : ref;
  return element(name, {
    'rois:authority': authority,
    'rois:code': code,
    'rois:codebook_ref': codebook_ref,
    'rois:version': version,
  });
}

export function parameter_xml({ name, data_type_ref, values }: Parameter, as = 'parameter'): string {
  const texts = values.map((text) => text_element('rois:value', text));
  return element(as, { 'rois:name': name }, component_ref_xml(data_type_ref, 'rois:data_type_ref'), ...texts);
}

export function sequence_xml(units: readonly CommandUnit[]): string {
  return element('rois:CommandUnitSequence', {}, ...units.map(unit_xml));
}

function unit_xml(unit: CommandUnit): string {
  const name = 'rois:command_unit_list';
  const attributes = (type?: string) => ({ 'xsi:type': type, 'rois:delay_time': whole(unit.delay_time) });
  switch (unit.kind) {
    case 'command':
      return command_xml(name, unit);
    case 'delay':
      return element(name, attributes());
    case 'concurrent': {
      const branches = unit.branches.map((branch) =>
        element('rois:branch_list', {}, ...branch.map((one) => command_xml('rois:command_list', one))),
      );
      return element(name, attributes('rois:ConcurrentCommandsType'), ...branches);
    }
    case 'sequential':
      return element(name, attributes('rois:SequentialCommandUnitType'), ...unit.units.map(unit_xml));
    case 'parallel':
      return element(name, attributes('rois:ParallelCommandUnitType'), ...unit.units.map(unit_xml));
  }
}

function whole(n: number | undefined): number | undefined {
  return n && Math.round(n);
}

function command_xml(name: string, unit: CommandMessage): string {
  const given = unit.arguments.map((one) => parameter_xml(one, 'rois:parameter'));
  return element(
    name,
    {
      'xsi:type': 'rois:CommandMessageType',
      'rois:command_type': unit.command_type,
      'rois:command_id': unit.command_id,
      'rois:delay_time': whole(unit.delay_time),
    },
    component_ref_xml(unit.component_ref, 'rois:component_ref'),
    given.length === 0 ? '' : element('rois:arguments', {}, ...given),
  );
}
