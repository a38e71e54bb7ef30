// XML for display: coloured pieces, one element on each line. Accepts any text; invalid XML stays plain.

export type PieceKind = 'mark' | 'name' | 'attribute' | 'value' | 'text' | 'comment';

export interface Piece {
  kind: PieceKind;
  text: string;
}

const markup = /<!--[^]*?-->|<!\[CDATA\[[^]*?\]\]>|<\?[^]*?\?>|<\/?[^\s<>/="']+(?:\s+[^\s<>/="']+\s*=\s*(?:"[^"]*"|'[^']*'))*\s*\/?>/g;
const inside = /(^<\/?|^<\?)([^\s<>/="'?]+)|([^\s<>/="'?]+)(\s*=\s*)("[^"]*"|'[^']*')|\/?>$|\?>$|\s+/g;

/** The pieces of a text in order; joined, they are the text. */
export function pieces_of(text: string): Piece[] {
  const pieces: Piece[] = [];
  const add = (kind: PieceKind, piece: string | undefined) => {
    if (piece === undefined || piece === '') return;
    const last = pieces[pieces.length - 1];
    if (last?.kind === kind) last.text += piece;
    else pieces.push({ kind, text: piece });
  };
  let end = 0;
  for (const found of text.matchAll(markup)) {
    add('text', text.slice(end, found.index));
    end = found.index + found[0].length;
    if (found[0].startsWith('<!--')) add('comment', found[0]);
    else if (found[0].startsWith('<![')) add('text', found[0]);
    else add_tag(found[0], add);
  }
  add('text', text.slice(end));
  return pieces;
}

function add_tag(tag: string, add: (kind: PieceKind, piece: string | undefined) => void): void {
  let end = 0;
  for (const found of tag.matchAll(inside)) {
    add('mark', tag.slice(end, found.index));
    end = found.index + found[0].length;
    const [all, open, name, attribute, equals, value] = found;
    if (open !== undefined) {
      add('mark', open);
      add('name', name);
    } else if (attribute !== undefined) {
      add('attribute', attribute);
      add('mark', equals);
      add('value', value);
    } else add('mark', all);
  }
  add('mark', tag.slice(end));
}

/** One element on each line, indented; elements with only text stay on one line. Text that is not XML is returned unchanged. */
export function laid_out(text: string): string {
  const lines: string[] = [];
  let depth = 0;
  let end = 0;
  const line = (what: string) => lines.push('  '.repeat(Math.max(0, depth)) + what);
  const found = [...text.matchAll(markup)];
  for (let i = 0; i < found.length; ++i) {
    const tag = found[i]!;
    const before = text.slice(end, tag.index).trim();
    if (before !== '') line(before);
    end = tag.index + tag[0].length;
    const next = found[i + 1];
    if (tag[0].startsWith('</')) {
      depth -= 1;
      line(tag[0]);
    } else if (tag[0].startsWith('<!') || tag[0].startsWith('<?') || tag[0].endsWith('/>')) line(tag[0]);
    else if (next?.[0].startsWith('</')) {
      line(tag[0] + text.slice(end, next.index) + next[0]);
      end = next.index + next[0].length;
      i += 1;
    } else {
      line(tag[0]);
      depth += 1;
    }
  }
  const rest = text.slice(end).trim();
  return found.length === 0 || depth !== 0 ? text : [...lines, ...(rest === '' ? [] : [rest])].join('\n');
}

const entities: Record<string, string> = { lt: '<', gt: '>', quot: '"', apos: "'", amp: '&' };

/** Resolves the predefined entities. */
export function unescaped(text: string): string {
  return text.replace(/&(lt|gt|quot|apos|amp);/g, (_, name: string) => entities[name]!).trim();
}
