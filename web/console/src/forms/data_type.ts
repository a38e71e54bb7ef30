// Data types of profiles (docs/profiles.md) and validation of values.

export type Kind =
  'integer' | 'number' | 'bool' | 'text' | 'date_time' | 'date' | 'time' | 'identifier' | 'component_status' | 'stream_status';

export interface DataType {
  kind: Kind;
  is_list: boolean;
  /** Name in the profile, without the URN. */
  name: string;
  /** Limits of an integer. */
  least?: bigint;
  most?: bigint;
}

/** A problem with a value; `texts.ts` has its text. */
export type Problem =
  | { what: 'missing' }
  | { what: 'either'; other: string }
  | { what: 'not_of_kind'; kind: Kind }
  | { what: 'out_of_range'; least: bigint; most: bigint }
  | { what: 'unwritable' };

const int = [-(2n ** 31n), 2n ** 31n - 1n] as const;
const longest = 2n ** 63n - 1n;
const ranges: Record<string, readonly [bigint, bigint]> = {
  int, integer: int,
  unlimitednatural: [0n, int[1]], nonnegativeinteger: [0n, int[1]], positiveinteger: [1n, int[1]],
  nonpositiveinteger: [int[0], 0n], negativeinteger: [int[0], -1n],
  long: [-longest - 1n, longest], short: [-0x8000n, 0x7fffn], byte: [-0x80n, 0x7fn],
  unsignedlong: [0n, longest], unsignedint: [0n, 0xffff_ffffn], unsignedshort: [0n, 0xffffn], unsignedbyte: [0n, 0xffn],
};
const kinds: Record<string, Kind> = {
  double: 'number', real: 'number', float: 'number', decimal: 'number', number: 'number',
  bool: 'bool', boolean: 'bool',
  datetime: 'date_time', date: 'date', time: 'time',
  roisidentifier: 'identifier', rois_identifier: 'identifier',
  component_status: 'component_status', componentstatus: 'component_status',
  stream_status: 'stream_status', streamstatus: 'stream_status',
};

/** The type for the code of a `data_type_ref`. Unknown types are texts, whose values are not checked. */
export function data_type(code: string): DataType {
  const text = without_urn(code.trim());
  const item = /^(.*)\[\]$/.exec(text)?.[1] ?? /^(?:Set|List|Sequence|seq)\s*<(.+)>$/i.exec(text)?.[1];
  const name = last_part((item ?? text).trim());
  const range = ranges[name.toLowerCase()];
  const is_list = item !== undefined;
  if (range) return { kind: 'integer', is_list, name, least: range[0], most: range[1] };
  return { kind: kinds[name.toLowerCase()] ?? 'text', is_list, name };
}

function without_urn(code: string): string {
  return /^urn:x-rois:def:datatype:/i.test(code) ? code.slice(code.lastIndexOf(':') + 1) : code;
}

function last_part(code: string): string {
  return code.slice(Math.max(code.lastIndexOf(':'), code.lastIndexOf('#'), code.lastIndexOf('/')) + 1);
}

/** Whether a list of these items is written in one text. */
export function is_packed({ kind }: DataType): boolean {
  return kind === 'integer' || kind === 'number' || kind === 'bool';
}

/** All values of a type that has a fixed set. */
export function all_values({ kind }: DataType): readonly string[] | undefined {
  switch (kind) {
    case 'bool':
      return ['true', 'false'];
    case 'component_status':
      return ['UNINITIALIZED', 'READY', 'BUSY', 'WARNING', 'ERROR'];
    case 'stream_status':
      return ['STREAMING_NOT_RUNNING', 'STREAMING_NOT_CONNECTED', 'STREAMING_RUNNING', 'STREAMING_SUSPENDED', 'STREAMING_RESUMED'];
    default:
      return undefined;
  }
}

const shapes: Partial<Record<Kind, RegExp>> = {
  integer: /^[+-]?\d+$/,
  number: /^([+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?|[+-]?INF|NaN)$/i,
  bool: /^(true|false|1|0)$/,
  identifier: /\S/,
};
const a_date = /^(\d{4})-(\d\d)-(\d\d)/;
const a_time = /^(?:[01]\d|2[0-3]):[0-5]\d:[0-5]\d(?:\.\d+)?/;
const a_zone = /^(?:Z|[+-](?:(?:0\d|1[0-3]):[0-5]\d|14:00))$/;
/** Characters that XML 1.0 does not allow. */
export const unwritable = /[^\t\n\r\u0020-\uD7FF\uE000-\uFFFD\u{10000}-\u{10FFFF}]/u;

/** The problem with one item; undefined if it is valid. */
export function problem_of(type: DataType, text: string): Problem | undefined {
  if (unwritable.test(text)) return { what: 'unwritable' };
  if (type.kind === 'text') return undefined;
  const value = text.trim();
  if (!is_of_kind(type, value)) return { what: 'not_of_kind', kind: type.kind };
  if (type.kind !== 'integer') return undefined;
  const number = BigInt(value.replace(/^\+/, ''));
  const { least = 0n, most = 0n } = type;
  return number < least || number > most ? { what: 'out_of_range', least, most } : undefined;
}

function is_of_kind(type: DataType, value: string): boolean {
  const { kind } = type;
  if (kind === 'component_status' || kind === 'stream_status') return all_values(type)!.includes(value);
  if (kind === 'date') return zone_may_follow(after_date(value));
  if (kind === 'time') return zone_may_follow(after_time(value));
  if (kind === 'date_time') {
    const rest = after_date(value);
    return rest !== undefined && rest.startsWith('T') && a_zone.test(after_time(rest.slice(1)) ?? '');
  }
  return shapes[kind]?.test(value) ?? true;
}

function zone_may_follow(rest: string | undefined): boolean {
  return rest !== undefined && (rest === '' || a_zone.test(rest));
}

// The text after the date, if the date exists.
function after_date(text: string): string | undefined {
  const found = a_date.exec(text);
  if (!found) return undefined;
  const [year, month, day] = found.slice(1).map(Number) as [number, number, number];
  const date = new Date(Date.UTC(2000, month - 1, day));
  date.setUTCFullYear(year, month - 1, day);
  return date.getUTCMonth() === month - 1 && date.getUTCDate() === day ? text.slice(found[0].length) : undefined;
}

function after_time(text: string): string | undefined {
  const found = a_time.exec(text);
  return found ? text.slice(found[0].length) : undefined;
}
