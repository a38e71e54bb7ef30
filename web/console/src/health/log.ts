// The session's error log: errors, gaps, refusals, lost links.
import { code_of, parse_xml } from 'rois-client';

import type { Console } from '../state/console';
import type { Span } from '../state/history';
import type { CommandEntry } from '../state/session/commands_state';
import type { LoggedDocument } from '../state/session/document_log';
import type { ErrorEntry, GapEntry } from '../state/session/events_state';
import { placed_commands, units_of } from '../state/session/sequences';
import { unescaped } from '../ui';

export type LogEntry = { at: number; key: string } & (
  | { kind: 'error'; entry: ErrorEntry }
  | { kind: 'gap'; entry: GapEntry }
  | { kind: 'refused'; document: LoggedDocument }
  | { kind: 'command'; command: CommandEntry }
  | { kind: 'link'; span: Span }
);

/** Newest first. Bounded, because its sources are rings. */
export function log_of({ events, traffic, history, commands }: Console): LogEntry[] {
  const entries: LogEntry[] = [];
  for (const entry of events.errors) entries.push({ kind: 'error', at: entry.at, key: `error ${entry.number}`, entry });
  for (const entry of events.gaps) entries.push({ kind: 'gap', at: entry.at, key: `gap ${entry.at}`, entry });
  for (const document of traffic.refused) entries.push({ kind: 'refused', at: document.at, key: `document ${document.number}`, document });
  for (const command of commands.all)
    if (/^(ERROR|TIMEOUT|OUT_OF_RESOURCES)$/.test(command.state))
      entries.push({ kind: 'command', at: command.ended_at!, key: `command ${command.id}`, command });
  for (const span of [...history.past, ...history.present.values()])
    if (span.kind === 'link' && /^(lost|refused|draining|token)$/.test(span.value))
      entries.push({ kind: 'link', at: span.from, key: `span ${span.number}`, span });
  return entries.sort((a, b) => b.at - a.at);
}

/** The engine's reason for a refusal; may be empty. */
export function reason_of({ text }: LoggedDocument): string {
  const reason = /<(?:\w+:)?reason>([^<]*)</.exec(text)?.[1] ?? '';
  return unescaped(reason);
}

/** The component of a refusal. For a sequence, the component of the refused step. */
export function refused_component(document: LoggedDocument): string {
  const { component = '', request } = document;
  if (request?.name !== 'execute') return component;
  try {
    const all = placed_commands(units_of(parse_xml(request.text))).map(({ path, command }) => ({
      path,
      ref: code_of(command.component_ref),
    }));
    const reason = reason_of(document);
    const meant = all.find(({ path }) => reason.startsWith(`${path}:`));
    return meant ? meant.ref : [...new Set(all.map(({ ref }) => ref))].join(', ');
  } catch {
    return component; // the refused text may not be XML
  }
}
