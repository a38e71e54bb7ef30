// Values in messages: identifiers, parameters, results, places (tables 9, 16 to 19; RLS data).

/** RoIS_Identifier (table 9): a code, unique within its codebook. */
export interface Identifier {
  code: string;
  authority?: string;
  codebook_ref?: string;
  version?: string;
}

/** An identifier, or its code alone. */
export type Ref = Identifier | string;

export function code_of(ref: Ref): string {
  return typeof ref === 'string' ? ref : ref.code;
}

/** A value with its type from the component's profile: `int`, `string[]`, `RoISIdentifier`, ... */
export interface Value {
  data_type_ref: Identifier;
  /** One text. Lists have one text for each item, except lists of numbers and bools. */
  values: string[];
}

/** Parameter (table 16): a named value. */
export interface Parameter extends Value {
  name: string;
}

/** Makes values of each type. `int` and `ints` round. */
export const value = {
  int: (n: number): Value => made('int', int_text(n)),
  double: (n: number): Value => made('double', double_text(n)),
  bool: (b: boolean): Value => made('bool', String(b)),
  string: (text: string): Value => made('string', text),
  date_time: (time: Date): Value => made('DateTime', time.toISOString()),
  identifier: (ref: Ref): Value =>
    typeof ref === 'string' || ref.codebook_ref === undefined
      ? made('RoISIdentifier', code_of(ref))
      : { data_type_ref: { code: 'RoISIdentifier', codebook_ref: ref.codebook_ref }, values: [ref.code] },
  ints: (list: number[]): Value => made('int[]', list.map(int_text).join(' ')),
  doubles: (list: number[]): Value => made('double[]', list.map(double_text).join(' ')),
  bools: (list: boolean[]): Value => made('bool[]', list.join(' ')),
  strings: (list: string[]): Value => ({ data_type_ref: { code: 'string[]' }, values: list }),
  identifiers: (list: Ref[]): Value => ({ data_type_ref: { code: 'RoISIdentifier[]' }, values: list.map(code_of) }),
};

function made(type: string, text: string): Value {
  return { data_type_ref: { code: type }, values: [text] };
}

function int_text(n: number): string {
  return String(Math.round(n));
}

function double_text(n: number): string {
  return Number.isNaN(n) ? 'NaN' : Number.isFinite(n) ? String(n) : n < 0 ? '-INF' : 'INF';
}

/**
 * A value or its plain form: a text is a `string`, a whole number an `int`, another number a `double`, a Date a `DateTime`, a list of
 * texts a `string[]`. Other types, and a `double` that may be whole, need `value`.
 */
export type Argument = Value | string | number | boolean | Date | string[];

/** Arguments by name; undefined ones are omitted. */
export type Arguments = Record<string, Argument | undefined>;

export function parameters_of(named: Arguments): Parameter[] {
  const list: Parameter[] = [];
  for (const [name, argument] of Object.entries(named))
    if (argument !== undefined) list.push({ name, ...value_of(argument) });
  return list;
}

function value_of(argument: Argument): Value {
  if (typeof argument === 'string') return value.string(argument);
  if (typeof argument === 'number') return Number.isInteger(argument) ? value.int(argument) : value.double(argument);
  if (typeof argument === 'boolean') return value.bool(argument);
  if (argument instanceof Date) return value.date_time(argument);
  return Array.isArray(argument) ? value.strings(argument) : argument;
}

/** The location of an entity: mm, degrees counter-clockwise, in the frame `crs`. */
export interface Located {
  of: string; // name of the result that it belongs to
  ref: string; // the entity's code
  crs: string;
  position: [x: number, y: number, z: number];
  orientation?: [roll: number, pitch: number, yaw: number];
  reliability?: number; // 0 to 1
  covariance?: number[]; // row by row, mm and degrees, position before orientation
}

/** A pose on the floor: mm, degrees counter-clockwise. */
export interface Pose {
  x: number;
  y: number;
  th: number;
}

/** Parses `x, y, th` or `x, y`; undefined if invalid. */
export function pose_of(text: string): Pose | undefined {
  const [x, y, th = 0, ...more] = text.split(',').map((part) => (part.trim() === '' ? NaN : Number(part)));
  if (x === undefined || y === undefined || more.length > 0 || ![x, y, th].every(Number.isFinite)) return undefined;
  return { x, y, th };
}

export function pose_text({ x, y, th }: Pose): string {
  return `${x}, ${y}, ${th}`;
}

/** The named values of an answer or an event. Getters return undefined (lists: empty) if a value is missing or has another type. */
export class Results {
  constructor(
    readonly parameters: Parameter[] = [],
    readonly located: Located[] = [],
  ) {}

  /** Names are case-insensitive. */
  get(name: string): Parameter | undefined {
    return this.parameters.find((one) => one.name.toLowerCase() === name.toLowerCase());
  }

  /** The first text. */
  text(name: string): string | undefined {
    return this.get(name)?.values[0];
  }

  /** All items, splitting lists of numbers and bools. */
  texts(name: string): string[] {
    const found = this.get(name);
    if (found === undefined) return [];
    const in_one_text = /(^|:)(int|double|bool)\[\]$/i.test(found.data_type_ref.code);
    return in_one_text ? found.values.join(' ').split(/\s+/).filter((item) => item !== '') : found.values;
  }

  number(name: string): number | undefined {
    return this.numbers(name)[0];
  }

  /** The items that are numbers. */
  numbers(name: string): number[] {
    return this.texts(name).map(number_of).filter((n): n is number => n !== undefined);
  }

  bool(name: string): boolean | undefined {
    const text = this.text(name)?.trim();
    return text === 'true' || text === '1' ? true : text === 'false' || text === '0' ? false : undefined;
  }

  time(name: string): Date | undefined {
    const time = new Date(this.text(name) ?? '');
    return Number.isNaN(time.getTime()) ? undefined : time;
  }

  /** The items that are poses. */
  poses(name: string): Pose[] {
    return this.texts(name).map(pose_of).filter((pose): pose is Pose => pose !== undefined);
  }
}

function number_of(text: string): number | undefined {
  const trimmed = text.trim();
  if (/^[+-]?INF$/.test(trimmed)) return trimmed.startsWith('-') ? -Infinity : Infinity;
  const n = trimmed === '' ? NaN : Number(trimmed);
  return Number.isNaN(n) ? undefined : n;
}
