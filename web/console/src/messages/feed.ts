// The rows of the message list: documents and gaps that match the filter, updated incrementally.
import type { LoggedDocument } from '../state/session/document_log';
import type { GapEntry } from '../state/session/events_state';

export type Category = 'event' | 'completed' | 'error' | 'notice' | 'request' | 'answer';
export const categories: readonly Category[] = ['event', 'completed', 'error', 'notice', 'request', 'answer'];

export interface Filter {
  hidden: ReadonlySet<Category>;
  component: string; // empty: all
  text: string; // empty: all; case-insensitive
  with_own: boolean; // include the console's own requests
}

export const no_filter: Filter = { hidden: new Set(), component: '', text: '', with_own: false };

export type Row = LoggedDocument | GapEntry;

export function is_gap(row: Row): row is GapEntry {
  return 'gap' in row;
}

export function category_of({ kind, name, return_code }: LoggedDocument): Category {
  if (kind === 'fault' || name === 'receive_error' || (kind === 'answer' && return_code !== undefined && return_code !== 'OK'))
    return 'error';
  if (kind === 'request' || kind === 'answer') return kind;
  if (name === 'receive_event') return 'event';
  return name === 'completed' ? 'completed' : 'notice';
}

/** The source of the rows: the console's rings or a recording. */
export interface Source {
  documents: { readonly first: number; readonly end: number; numbered(number: number): LoggedDocument | undefined };
  gaps: { readonly first: number; readonly size: number; numbered(number: number): GapEntry | undefined };
  /** The component that a document concerns, even if it does not name it. */
  component_of(document: LoggedDocument): string;
}

const swept_after = 1000; // more rows

export class Feed {
  /** Grows in place. */
  readonly rows: Row[] = [];
  private next_document: number;
  private next_gap: number;
  private swept_at = swept_after;
  private readonly text: string;

  constructor(
    private readonly source: Source,
    private readonly filter: Filter,
  ) {
    this.text = filter.text.toLowerCase();
    this.next_document = source.documents.first;
    this.next_gap = source.gaps.first;
    this.update();
  }

  /** Adds new rows and removes forgotten ones. Returns whether anything changed. */
  update(): boolean {
    const { documents, gaps } = this.source;
    let changed = this.forget();
    if (this.rows.length >= this.swept_at) changed = this.sweep() || changed;
    const { end } = documents;
    for (this.next_document = Math.max(this.next_document, documents.first); this.next_document < end; ++this.next_document) {
      const document = documents.numbered(this.next_document);
      if (!document) continue; // its ring has dropped it already
      changed = (this.passes(document) && this.rows.push(document) > 0) || changed;
    }
    const gaps_end = gaps.first + gaps.size;
    for (this.next_gap = Math.max(this.next_gap, gaps.first); this.next_gap < gaps_end; ++this.next_gap)
      changed = this.insert(gaps.numbered(this.next_gap)!) || changed;
    return changed;
  }

  private forget(): boolean {
    const { documents } = this.source;
    const oldest = documents.numbered(documents.first)?.at ?? Infinity;
    let gone = 0;
    for (const row of this.rows) {
      if (is_gap(row) ? row.at >= oldest : row.number >= documents.first) break;
      gone += 1;
    }
    if (gone > 0) this.rows.splice(0, gone);
    return gone > 0;
  }

  // Rings forget at different rates, so forgotten rows may lie between others.
  private sweep(): boolean {
    const { documents } = this.source;
    const before = this.rows.length;
    let kept = 0;
    for (const row of this.rows) if (is_gap(row) || documents.numbered(row.number)) this.rows[kept++] = row;
    this.rows.length = kept;
    this.swept_at = kept + swept_after;
    return kept < before;
  }

  /** Whether the document matches the filter. */
  passes(document: LoggedDocument): boolean {
    const { hidden, component, with_own } = this.filter;
    if (document.is_own && !with_own) return false;
    if (hidden.has(category_of(document))) return false;
    if (component !== '' && this.source.component_of(document) !== component) return false;
    return this.text === '' || document.text.toLowerCase().includes(this.text);
  }

  // Inserts the gap by time. Gaps are few and almost always at the end.
  private insert(gap: GapEntry): boolean {
    let at = this.rows.length;
    while (at > 0 && this.rows[at - 1]!.at > gap.at) at -= 1;
    this.rows.splice(at, 0, gap);
    return true;
  }
}
