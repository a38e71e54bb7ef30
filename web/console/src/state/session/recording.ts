// Recordings of `rois record` and `rois replay`: one JSON object on each line.
import type { Environment } from '../base/environment';
import type { Direction, LoggedDocument } from './document_log';
import { Documents } from './documents';

const format = 'rois-recording-1';

export interface Recording {
  url: string; // of the engine; empty if unknown
  begun: string; // as in the file
  is_cut: boolean; // the last line was incomplete and is ignored
  documents: LoggedDocument[]; // `at`: ms since 1970, or since the begin if that is unknown
}

/** The file in pieces. Several sessions are marked. */
export function recording_of(documents: Iterable<LoggedDocument>, url: string): string[] {
  const list = [...documents];
  const begun = list[0]?.at ?? 0;
  const lines = [JSON.stringify({ recording: format, url, begun: new Date(begun).toISOString() })];
  const several = list.filter(is_connect).length > 1;
  let session = 1;
  let has_begun = false;
  for (const one of list) {
    if (is_connect(one) && has_begun) session += 1;
    has_begun = true;
    const at = Math.round((one.at - begun) * 1000) / 1e6;
    lines.push(JSON.stringify({ at, direction: one.direction, ...(several && { session: String(session) }), document: one.text }));
  }
  return lines.map((line) => `${line}\n`);
}

function is_connect({ direction, name }: LoggedDocument): boolean {
  return direction === 'out' && name === 'connect';
}

/** Throws an Error with the line and the reason. */
export function read_recording(text: string): Recording {
  const lines = text.split('\n').filter((line, i) => i === 0 || line.trim() !== '');
  const is_cut = lines.length > 1 && !text.endsWith('\n') && parsed(lines.at(-1)!) === undefined;
  if (is_cut) lines.pop();
  if (text.trim() === '') throw new Error('the recording is empty');
  const head = object_of(lines[0]!, 1);
  if (head['recording'] !== format) throw new Error(`line 1: expected a recording of the format ${format}`);
  const begun = String(head['begun'] ?? '');
  const zero = Date.parse(begun);
  const sessions = new Map<string, Documents>();
  let now = 0;
  const documents = lines.slice(1).map((line, i) => {
    const { at, direction, session = '', document } = object_of(line, i + 2);
    if (typeof at !== 'number' || typeof document !== 'string')
      throw new Error(`line ${i + 2}: 'at' (a number) or 'document' (a text) is missing`);
    if (direction !== 'in' && direction !== 'out') throw new Error(`line ${i + 2}: 'direction' must be "in" or "out"`);
    now = (Number.isNaN(zero) ? 0 : zero) + at * 1000;
    const logged = sessions_log(sessions, String(session), () => now).note(direction as Direction, document);
    logged.number = i;
    logged.is_own = false;
    return logged;
  });
  if (documents.length === 0) throw new Error('the recording is empty');
  return { url: String(head['url'] ?? ''), begun, is_cut, documents };
}

// Answers are paired with requests of their own session.
function sessions_log(sessions: Map<string, Documents>, session: string, now: () => number): Documents {
  const known = sessions.get(session);
  if (known) return known;
  // A log needs only the time.
  const world = { now, precise: now } as Partial<Environment> as Environment;
  const documents = new Documents(world, { most: 1, most_bytes: Infinity });
  sessions.set(session, documents);
  return documents;
}

/** Undefined if it is not JSON. */
function parsed(line: string): unknown {
  try {
    return JSON.parse(line);
  } catch {
    return undefined;
  }
}

function object_of(line: string, number: number): Record<string, unknown> {
  const read = parsed(line);
  if (typeof read === 'object' && read !== null) return read as Record<string, unknown>;
  throw new Error(`line ${number}: not a JSON object`);
}
