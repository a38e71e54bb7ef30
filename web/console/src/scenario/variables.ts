// Variables of a scenario (lists of texts) and the steps on them.
import { type Pose, pose_of, pose_text, type Results } from 'rois-client';

import type { Step, TakeResult, When } from './model';
import { Trouble } from './trouble';
import * as texts from './texts';

/** The names in braces, in order. */
export function names_in(text: string): string[] {
  const names: string[] = [];
  for (let begin = text.indexOf('{'); begin >= 0; begin = text.indexOf('{', begin + 1)) {
    const end = text.indexOf('}', begin);
    if (end < 0) break;
    names.push(text.slice(begin + 1, end));
  }
  return names;
}

/** Values joined for messages and texts. */
export function listed(values: Iterable<string>): string {
  return [...values].join(', ');
}

export class Variables {
  private values = new Map<string, readonly string[]>();

  constructor(at_first: Iterable<readonly [string, string]>) {
    for (const [name, value] of at_first) this.set(name, value);
  }

  get all(): ReadonlyMap<string, readonly string[]> {
    return this.values;
  }

  set(name: string, value: string): void {
    this.values.set(name, value === '' ? [] : [value]);
  }

  private of(name: string): readonly string[] {
    return this.values.get(name) ?? [];
  }

  /** Replaces {name} by the variable's value. */
  filled(text: string): string {
    let filled = '';
    for (;;) {
      const begin = text.indexOf('{');
      const end = text.indexOf('}', Math.max(begin, 0));
      if (begin < 0 || end < 0) return filled + text;
      filled += text.slice(0, begin) + listed(this.of(text.slice(begin + 1, end)));
      text = text.slice(end + 1);
    }
  }

  /** Runs the steps in order and returns the printed lines. Returns undefined, without changes, if one does not hold. */
  take(steps: readonly Step[], results: Results | undefined): string[] | undefined {
    const before = new Map(this.values);
    const printed: string[] = [];
    for (const step of steps) {
      if (this.apply(step, results, printed)) continue;
      this.values = before;
      return undefined;
    }
    return printed;
  }

  private apply(step: Step, results: Results | undefined, printed: string[]): boolean {
    switch (step.kind) {
      case 'set':
        this.set(step.variable, this.filled(step.text));
        return true;
      case 'add':
        this.values.set(step.variable, [...this.of(step.variable), this.filled(step.text)]);
        return true;
      case 'count':
        this.set(step.variable, String(whole_number(this.of(step.variable)[0]) + 1));
        return true;
      case 'place':
        this.set(step.variable, text_of(before(place(this.filled(step.before)), step.distance, step.turn)));
        return true;
      case 'print':
        printed.push(this.filled(step.text));
        return true;
      case 'take':
        return this.take_result(step, results);
      case 'when':
        return this.holds(step);
    }
  }

  private take_result(step: TakeResult, results: Results | undefined): boolean {
    const result = results?.get(step.result);
    const other = step.beside === '' ? undefined : results?.get(step.beside);
    if (!results || !result || (!other && step.beside !== '')) return false;
    const is = this.filled(step.is);
    const found = result.values.find((value, i) => {
      if (other && other.values[i] !== is) return false;
      const is_it = (one: string) => (step.apart > 0 ? distance(place(one), place(value)) < step.apart : one === value);
      return step.not_in === '' || !this.of(step.not_in).some(is_it);
    });
    if (found === undefined) return false;
    this.set(step.variable, found);
    return true;
  }

  private holds({ variable, relation, operand, within }: When): boolean {
    const values = this.of(variable);
    const is_in = (list: readonly string[]) => values.some((value) => list.includes(value));
    switch (relation) {
      case 'is':
        return listed(values) === this.filled(operand);
      case 'is_not':
        return listed(values) !== this.filled(operand);
      case 'in':
        return is_in(this.of(operand));
      case 'not_in':
        return !is_in(this.of(operand));
      case 'empty':
        return values.length === 0;
      case 'not_empty':
        return values.length > 0;
      case 'near':
        return values.length > 0 && distance(place(values[0]!), place(this.filled(operand))) <= within;
    }
  }
}

function whole_number(text = ''): number {
  const trimmed = text.trim();
  const read = /^[+-]?\d+$/.test(trimmed) ? Number(trimmed) : 0;
  return Math.abs(read) <= 0x7fff_ffff ? read : 0;
}

function place(text: string): Pose {
  return pose_of(text) ?? Trouble.raise(() => texts.no_place(text));
}

function distance(a: Pose, b: Pose): number {
  return Math.hypot(a.x - b.x, a.y - b.y);
}

/** The place `away` mm in front of a pose, facing it, turned by `turn` degrees to its left. */
function before({ x, y, th }: Pose, away: number, turn: number): Pose {
  const angle = ((th + turn) * Math.PI) / 180;
  return { x: x + away * Math.cos(angle), y: y + away * Math.sin(angle), th: th + turn + 180 };
}

// Rounded to 0.001.
function text_of({ x, y, th }: Pose): string {
  const rounded = (n: number) => Math.round(n * 1000) / 1000 + 0;
  return pose_text({ x: rounded(x), y: rounded(y), th: rounded(th) });
}
