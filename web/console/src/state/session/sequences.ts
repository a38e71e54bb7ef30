// Parses command sequences from documents: sent texts and recordings.
import { type CommandMessage, type CommandUnit, identifier_of, namespaces, parameter_of, type XmlElement } from 'rois-client';

const { rois, xsi } = namespaces;

/** A command and its place, in the engine's notation: `command_unit_list[2]/branch_list[1]/command_list[1]`. */
export interface PlacedCommand {
  path: string;
  command: CommandMessage;
}

/** The units of a `CommandUnitSequence` or of a document with one; empty if there is none. */
export function units_of(element: XmlElement): CommandUnit[] {
  const sequence = element.name === 'CommandUnitSequence' ? element : element.child('CommandUnitSequence');
  return (sequence?.all('command_unit_list') ?? []).map(unit_of);
}

/** All commands in document order. */
export function placed_commands(units: readonly CommandUnit[], around = ''): PlacedCommand[] {
  return units.flatMap((unit, i) => {
    const path = `${around}command_unit_list[${i + 1}]`;
    if (unit.kind === 'command') return [{ path, command: unit }];
    if (unit.kind === 'delay') return [];
    if (unit.kind !== 'concurrent') return placed_commands(unit.units, `${path}/`);
    return unit.branches.flatMap((branch, j) =>
      branch.map((command, k) => ({ path: `${path}/branch_list[${j + 1}]/command_list[${k + 1}]`, command })),
    );
  });
}

function unit_of(element: XmlElement): CommandUnit {
  const type = (element.attribute('type', xsi) ?? '').replace(/^.*:/, '').replace(/Type$/, '');
  const delay = delay_of(element);
  switch (type) {
    case 'CommandMessage':
      return command_of(element);
    case 'ConcurrentCommands':
      return { kind: 'concurrent', branches: branches_of(element), ...delay };
    case 'SequentialCommandUnit':
      return { kind: 'sequential', units: element.all('command_unit_list').map(unit_of), ...delay };
    case 'ParallelCommandUnit':
      return { kind: 'parallel', units: element.all('command_unit_list').map(unit_of), ...delay };
    default:
      return { kind: 'delay', delay_time: delay.delay_time ?? 0 };
  }
}

// In the flat form, each command is a branch.
function branches_of(element: XmlElement): CommandMessage[][] {
  const branches = element.all('branch_list').map((branch) => branch.all('command_list').map(command_of));
  return branches.length > 0 ? branches : element.all('command_list').map((one) => [command_of(one)]);
}

function command_of(element: XmlElement): CommandMessage {
  const ref = element.child('component_ref');
  return {
    kind: 'command',
    component_ref: ref === undefined ? '' : identifier_of(ref),
    command_type: element.attribute('command_type', rois) ?? '',
    command_id: element.attribute('command_id', rois) ?? '',
    arguments: (element.child('arguments')?.all('parameter') ?? []).map(parameter_of),
    ...delay_of(element),
  };
}

function delay_of(element: XmlElement): { delay_time?: number } {
  const text = element.attribute('delay_time', rois);
  return text === undefined ? {} : { delay_time: Number(text) };
}
