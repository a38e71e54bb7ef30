// Strict XML 1.0 with namespaces, as an engine sends it: no document types, no processing instructions, only the five predefined
// entities. Independent of RoIS.

/** A document is not well-formed. `offset` counts UTF-16 units from 0. */
export class XmlError extends Error {
  override readonly name = 'XmlError';
  constructor(
    what: string,
    readonly offset: number,
  ) {
    super(`${what} at offset ${offset}`);
  }
}

export interface XmlAttribute {
  name: string; // without its prefix
  namespace: string; // empty without a prefix
  value: string;
}

/** An element of a document. */
export class XmlElement {
  readonly attributes: XmlAttribute[] = [];
  readonly children: XmlElement[] = [];
  /** Own text, without that of children. */
  text = '';

  constructor(
    /** Without its prefix. */
    readonly name: string,
    readonly namespace: string,
  ) {}

  /** The value of an attribute; undefined if missing. */
  attribute(name: string, namespace = ''): string | undefined {
    return this.attributes.find((one) => one.name === name && one.namespace === namespace)?.value;
  }

  /** The first child with this name, in any namespace. */
  child(name: string): XmlElement | undefined {
    return this.children.find((one) => one.name === name);
  }

  /** All children with this name, in any namespace. */
  all(name: string): XmlElement[] {
    return this.children.filter((one) => one.name === name);
  }

  /** The text of the first child with this name; empty if there is none. */
  text_of(name: string): string {
    return this.child(name)?.text ?? '';
  }
}

// --- Writing ---

// Everything outside XML 1.0's Char (production 2).
const forbidden = /[^\t\n\r\u0020-\uD7FF\uE000-\uFFFD\u{10000}-\u{10FFFF}]/u;

const escapes: Record<string, string> = {
  '&': '&amp;',
  '<': '&lt;',
  '>': '&gt;',
  '"': '&quot;',
  '\t': '&#9;',
  '\n': '&#10;',
  '\r': '&#13;',
};

function checked(text: string): string {
  const at = forbidden.exec(text);
  if (at) throw new XmlError(`U+${at[0].codePointAt(0)!.toString(16).toUpperCase().padStart(4, '0')} is not allowed in XML`, at.index);
  return text;
}

/** Escapes element content. Throws XmlError for characters that XML does not allow. */
export function escape_text(text: string): string {
  return checked(text).replace(/[&<>\r]/g, (one) => escapes[one]!);
}

/** Escapes an attribute value for double quotes. Throws as `escape_text`. */
export function escape_attribute(text: string): string {
  return checked(text).replace(/[&<>"\t\n\r]/g, (one) => escapes[one]!);
}

/** Writes an element; `content` is XML. Omits undefined attributes. */
export function element(name: string, attributes: Record<string, string | number | boolean | undefined>, ...content: string[]): string {
  let start = `<${name}`;
  for (const [key, value] of Object.entries(attributes))
    if (value !== undefined) start += ` ${key}="${escape_attribute(String(value))}"`;
  const inside = content.join('');
  return inside === '' ? `${start}/>` : `${start}>${inside}</${name}>`;
}

/** Writes an element that contains only text. */
export function text_element(name: string, text: string): string {
  return element(name, {}, escape_text(text));
}

// --- Reading ---

const most_depth = 256;

const space = /[ \t\n]*/y;
const name_start =
  '[:A-Z_a-z\\u{C0}-\\u{D6}\\u{D8}-\\u{F6}\\u{F8}-\\u{2FF}\\u{370}-\\u{37D}\\u{37F}-\\u{1FFF}\\u{200C}\\u{200D}' +
  '\\u{2070}-\\u{218F}\\u{2C00}-\\u{2FEF}\\u{3001}-\\u{D7FF}\\u{F900}-\\u{FDCF}\\u{FDF0}-\\u{FFFD}\\u{10000}-\\u{EFFFF}]';
const name_part = `(?:${name_start}|[-.0-9\\u{B7}\\u{300}-\\u{36F}\\u{203F}\\u{2040}])`;
const a_name = new RegExp(`${name_start}${name_part}*`, 'uy');
const declaration =
  /<\?xml[ \t\n]+version[ \t\n]*=[ \t\n]*(["'])1\.[0-9]+\1([ \t\n]+encoding[ \t\n]*=[ \t\n]*(["'])[Uu][Tt][Ff]-8\3)?([ \t\n]+standalone[ \t\n]*=[ \t\n]*(["'])(yes|no)\5)?[ \t\n]*\?>/y;
const a_reference = /&(?:#x([0-9A-Fa-f]{1,8})|#([0-9]{1,10})|(amp|lt|gt|quot|apos));/y;
const predefined: Record<string, string> = { amp: '&', lt: '<', gt: '>', quot: '"', apos: "'" };

type Scope = Map<string, string>; // prefix -> namespace

const outermost: Scope = new Map([
  ['', ''],
  ['xml', 'http://www.w3.org/XML/1998/namespace'],
]);

interface Open {
  element: XmlElement;
  written: string; // its name with its prefix
  scope: Scope;
}

class XmlReader {
  private at = 0;

  constructor(private readonly text: string) {}

  document(): XmlElement {
    this.match(declaration);
    this.misc();
    if (!this.follows('<')) this.fail('expected an element');
    const root = this.root();
    this.misc();
    if (this.at < this.text.length) this.fail('unexpected content after the document element');
    return root;
  }

  private fail(what: string, at = this.at): never {
    throw new XmlError(what, at);
  }

  private follows(mark: string): boolean {
    return this.text.startsWith(mark, this.at);
  }

  private take(mark: string): boolean {
    if (!this.follows(mark)) return false;
    this.at += mark.length;
    return true;
  }

  private match(pattern: RegExp): RegExpExecArray | null {
    pattern.lastIndex = this.at;
    const found = pattern.exec(this.text);
    if (found) this.at = pattern.lastIndex;
    return found;
  }

  private skip_space(): boolean {
    return this.match(space)![0] !== '';
  }

  // Skips white space and comments around the document element.
  private misc(): void {
    for (;;) {
      this.skip_space();
      if (!this.take('<!--')) return;
      this.comment();
    }
  }

  private comment(): void {
    const end = this.text.indexOf('--', this.at);
    if (end < 0 || this.text[end + 2] !== '>') this.fail("a comment does not end with '-->'", end < 0 ? this.at : end);
    this.at = end + 3;
  }

  private root(): XmlElement {
    const open: Open[] = [];
    this.at += 1;
    let root = this.start_tag(open, outermost);
    const first = root;
    while (open.length > 0) {
      root = open[open.length - 1]!.element;
      const next = this.text.indexOf('<', this.at);
      if (next < 0) this.fail(`<${open[open.length - 1]!.written}> is not closed`, this.text.length);
      root.text += this.content(next, false);
      this.at += 1;
      if (this.take('/')) this.end_tag(open);
      else if (this.take('!--')) this.comment();
      else if (this.take('![CDATA[')) this.cdata(root);
      else if (this.follows('!') || this.follows('?'))
        this.fail('document types and processing instructions are not supported', this.at - 1);
      else root.children.push(this.start_tag(open, open[open.length - 1]!.scope));
    }
    return first;
  }

  private cdata(into: XmlElement): void {
    const end = this.text.indexOf(']]>', this.at);
    if (end < 0) this.fail('a CDATA section is not closed');
    into.text += this.text.slice(this.at, end);
    this.at = end + 3;
  }

  // Text until `end` with references resolved.
  private content(end: number, of_attribute: boolean): string {
    let text = '';
    while (this.at < end) {
      const reference = this.text.indexOf('&', this.at);
      const until = reference < 0 || reference > end ? end : reference;
      const plain = this.text.slice(this.at, until);
      if (!of_attribute && plain.includes(']]>')) this.fail("']]>' is not allowed in text");
      text += of_attribute ? plain.replace(/[\t\n]/g, ' ') : plain;
      this.at = until;
      if (until < end) text += this.reference();
    }
    return text;
  }

  private reference(): string {
    const begin = this.at;
    const found = this.match(a_reference);
    if (!found) this.fail('unknown entity or character reference');
    if (found[3] !== undefined) return predefined[found[3]]!;
    const code = found[1] !== undefined ? parseInt(found[1], 16) : parseInt(found[2]!, 10);
    if (code > 0x10ffff || (code >= 0xd800 && code < 0xe000) || forbidden.test(String.fromCodePoint(code)))
      this.fail('a reference to a character that is not allowed in XML', begin);
    return String.fromCodePoint(code);
  }

  private name(): string {
    return this.match(a_name)?.[0] ?? this.fail('expected a name');
  }

  private start_tag(open: Open[], around: Scope): XmlElement {
    const begin = this.at;
    if (open.length >= most_depth) this.fail(`elements nested deeper than ${most_depth}`);
    const written = this.name();
    const attributes = this.attributes();
    let scope = around;
    for (const [name, value, at] of attributes) {
      if (name !== 'xmlns' && !name.startsWith('xmlns:')) continue;
      if (scope === around) scope = new Map(around);
      const prefix = name.slice(6);
      if (prefix === 'xml' || prefix === 'xmlns' || (prefix !== '' && value === ''))
        this.fail(`'${name}' is not a valid namespace declaration`, at);
      scope.set(prefix, value);
    }
    const [name, namespace] = this.resolved(written, scope, begin, true);
    const made = new XmlElement(name, namespace);
    for (const [written_name, value, at] of attributes) {
      if (written_name === 'xmlns' || written_name.startsWith('xmlns:')) continue;
      const [own, its_namespace] = this.resolved(written_name, scope, at, false);
      if (made.attribute(own, its_namespace) !== undefined) this.fail(`'${written_name}' is a duplicate attribute`, at);
      made.attributes.push({ name: own, namespace: its_namespace, value });
    }
    if (this.take('/>')) return made;
    if (!this.take('>')) this.fail("expected '>'");
    open.push({ element: made, written, scope });
    return made;
  }

  private attributes(): [string, string, number][] {
    const found: [string, string, number][] = [];
    while (this.skip_space() && !this.follows('>') && !this.follows('/')) {
      const at = this.at;
      const name = this.name();
      if (found.some(([other]) => other === name)) this.fail(`'${name}' is a duplicate attribute`, at);
      this.skip_space();
      if (!this.take('=')) this.fail("expected '='");
      this.skip_space();
      const quote = this.text[this.at];
      if (quote !== '"' && quote !== "'") this.fail('expected a quote');
      const end = this.text.indexOf(quote, this.at + 1);
      if (end < 0) this.fail('an attribute value is not closed');
      this.at += 1;
      if (this.text.slice(this.at, end).includes('<')) this.fail("'<' is not allowed in an attribute value");
      const value = this.content(end, true);
      this.at += 1;
      found.push([name, value, at]);
    }
    return found;
  }

  // The local name and the namespace.
  private resolved(written: string, scope: Scope, at: number, is_element: boolean): [string, string] {
    const colon = written.indexOf(':');
    if (colon < 0) return [written, is_element ? scope.get('')! : ''];
    const name = written.slice(colon + 1);
    const namespace = scope.get(written.slice(0, colon));
    if (colon === 0 || name === '' || /^[-.0-9\u00B7]/.test(name) || name.includes(':')) this.fail(`'${written}' is not a valid name`, at);
    return [name, namespace ?? this.fail(`the prefix of '${written}' is not declared`, at)];
  }

  private end_tag(open: Open[]): void {
    const at = this.at;
    const written = this.name();
    const expected = open.pop()!.written;
    if (written !== expected) this.fail(`expected </${expected}>, not </${written}>`, at);
    this.skip_space();
    if (!this.take('>')) this.fail("expected '>'");
  }
}

/** Parses a document and returns its root. Throws XmlError if it is not well-formed or uses unsupported features (see above). */
export function parse_xml(text: string): XmlElement {
  const lines = text.startsWith('\uFEFF') ? text.slice(1) : text;
  const at = forbidden.exec(lines);
  if (at) throw new XmlError('a character that is not allowed in XML', at.index);
  return new XmlReader(lines.includes('\r') ? lines.replace(/\r\n?/g, '\n') : lines).document();
}
