// Conditions (QueryExpression of ISO 19143) built in code; docs/conditions.md of the gateway says what they mean.
import { element, text_element } from './xml.js';

/** What is meant, and perhaps in which order. */
export class Condition {
  constructor(
    /** A predicate as XML, with the prefixes `fes` and `gml`; empty: all. */
    readonly predicate: string,
    /** SortProperty elements as XML. */
    readonly order: string = '',
  ) {}

  /** The same, in this order; a second call says what counts among equals. */
  sorted_by(by: Expression | string, order: 'ASC' | 'DESC' = 'ASC'): Condition {
    const key = element('fes:SortProperty', {}, typeof by === 'string' ? property(by).xml : by.xml, text_element('fes:SortOrder', order));
    return new Condition(this.predicate, this.order + key);
  }

  /** The same restricted to what meets another one, too. */
  and(other: Condition): Condition {
    return new Condition(all_of(this, other).predicate, this.order);
  }

  /** What stands inside a message's `condition`. */
  get xml(): string {
    const filter = this.predicate === '' ? '' : element('fes:Filter', {}, this.predicate);
    return filter + (this.order === '' ? '' : element('fes:SortBy', {}, this.order));
  }
}

/** A condition as XML that was made elsewhere: what stands inside `condition`, with the prefixes `fes`, `gml`, `unr` and `rois`. */
export class WrittenCondition {
  constructor(readonly xml: string) {}
}

/** No restriction; for `everything.sorted_by(...)`. */
export const everything = new Condition('');

/** What a comparison can be about. */
export class Expression {
  constructor(readonly xml: string) {}
}

/** A point or a box. */
export class Geometry extends Expression {}

/** A point: mm, in the frame `crs`, that of whatever it is compared with when left out. */
export function point(x: number, y: number, crs?: string): Geometry {
  return new Geometry(element('gml:Point', { srsName: crs }, text_element('gml:pos', `${x} ${y}`)));
}

/** A box along the axes: mm. */
export function box(low: { x: number; y: number }, high: { x: number; y: number }, crs?: string): Geometry {
  return new Geometry(
    element(
      'gml:Envelope',
      { srsName: crs },
      text_element('gml:lowerCorner', `${low.x} ${low.y}`),
      text_element('gml:upperCorner', `${high.x} ${high.y}`),
    ),
  );
}

/** The distance of two positions or named places, in mm. */
export function distance(from: Expression | string, to: Operand): Expression {
  const argument = (of: Operand) => (of instanceof Geometry ? element('fes:Literal', {}, of.xml) : operand(of));
  return new Expression(element('fes:Function', { name: 'distance' }, argument(typeof from === 'string' ? property(from) : from), argument(to)));
}

/** A literal, a time, or an expression. A text is a literal; the name of a place is one, too. */
export type Operand = string | number | boolean | Date | Expression;

function operand(of: Operand): string {
  if (of instanceof Expression) return of.xml;
  return text_element('fes:Literal', of instanceof Date ? of.toISOString() : String(of));
}

function instant(time: Date): string {
  return element('gml:TimeInstant', {}, text_element('gml:timePosition', time.toISOString()));
}

/** How many of several values must meet a comparison, and whether the case of letters counts. */
export interface Matching {
  match_action?: 'Any' | 'All' | 'One';
  match_case?: boolean;
}

/** A value reference: `number`, `status`, `Property/volume`, ... */
export class Property extends Expression {
  constructor(readonly path: string) {
    super(text_element('fes:ValueReference', path));
  }

  equals(other: Operand, how?: Matching): Condition {
    return this.compared('EqualTo', other, how);
  }
  differs_from(other: Operand, how?: Matching): Condition {
    return this.compared('NotEqualTo', other, how);
  }
  less_than(other: Operand, how?: Matching): Condition {
    return this.compared('LessThan', other, how);
  }
  greater_than(other: Operand, how?: Matching): Condition {
    return this.compared('GreaterThan', other, how);
  }
  at_most(other: Operand, how?: Matching): Condition {
    return this.compared('LessThanOrEqualTo', other, how);
  }
  at_least(other: Operand, how?: Matching): Condition {
    return this.compared('GreaterThanOrEqualTo', other, how);
  }

  /** Both boundaries belong to it. */
  between(lower: Operand, upper: Operand): Condition {
    return new Condition(
      element(
        'fes:PropertyIsBetween',
        {},
        this.xml,
        element('fes:LowerBoundary', {}, operand(lower)),
        element('fes:UpperBoundary', {}, operand(upper)),
      ),
    );
  }

  /** `*` stands for any text, `?` for one character, `\` takes their meaning away. */
  like(pattern: string, how: { match_case?: boolean } = {}): Condition {
    const marks = { wildCard: '*', singleChar: '?', escapeChar: '\\', matchCase: how.match_case };
    return new Condition(element('fes:PropertyIsLike', marks, this.xml, text_element('fes:Literal', pattern)));
  }

  /** Has no value. */
  is_null(): Condition {
    return new Condition(element('fes:PropertyIsNull', {}, this.xml));
  }

  /** Lies in a box or a named place. */
  within(area: Operand): Condition {
    return this.related('Within', area);
  }
  intersects(area: Operand): Condition {
    return this.related('Intersects', area);
  }
  disjoint_from(area: Operand): Condition {
    return this.related('Disjoint', area);
  }

  /** No farther than so many mm from a point, box or named place. */
  no_farther_than(millimetres: number, from: Operand): Condition {
    return this.related('DWithin', from, element('fes:Distance', { uom: 'mm' }, String(millimetres)));
  }
  farther_than(millimetres: number, from: Operand): Condition {
    return this.related('Beyond', from, element('fes:Distance', { uom: 'mm' }, String(millimetres)));
  }

  after(time: Date): Condition {
    return new Condition(element('fes:After', {}, this.xml, instant(time)));
  }
  before(time: Date): Condition {
    return new Condition(element('fes:Before', {}, this.xml, instant(time)));
  }

  /** Without the ends of the period. */
  during(begin: Date, end: Date): Condition {
    const period = element(
      'gml:TimePeriod',
      {},
      text_element('gml:beginPosition', begin.toISOString()),
      text_element('gml:endPosition', end.toISOString()),
    );
    return new Condition(element('fes:During', {}, this.xml, period));
  }

  private compared(operator: string, other: Operand, how: Matching = {}): Condition {
    const attributes = { matchAction: how.match_action, matchCase: how.match_case };
    return new Condition(element(`fes:PropertyIs${operator}`, attributes, this.xml, operand(other)));
  }

  private related(operator: string, other: Operand, ...more: string[]): Condition {
    return new Condition(element(`fes:${operator}`, {}, this.xml, operand(other), ...more));
  }
}

export function property(path: string): Property {
  return new Property(path);
}

/** Components of this type: `Navigation`, or a whole URN. */
export function component_type(type: string): Condition {
  return property('component_type').equals(type_urn(type));
}

/** The URN of a component type, which may be given by its name alone when the specification has it. */
export function type_urn(type: string): string {
  return type.includes(':') ? type : `urn:x-rois:def:component:OMG::${type}`;
}

/** This component alone. */
export function component_ref(code: string): Condition {
  return property('component_ref').equals(code);
}

/** Their orders are passed over. */
export function all_of(...conditions: Condition[]): Condition {
  return joined('And', conditions);
}
export function any_of(...conditions: Condition[]): Condition {
  return joined('Or', conditions);
}
export function not(condition: Condition): Condition {
  return new Condition(element('fes:Not', {}, condition.predicate));
}

function joined(operator: string, conditions: Condition[]): Condition {
  const predicates = conditions.map((one) => one.predicate).filter((one) => one !== '');
  if (predicates.length < 2) return new Condition(predicates[0] ?? '');
  return new Condition(element(`fes:${operator}`, {}, ...predicates));
}
