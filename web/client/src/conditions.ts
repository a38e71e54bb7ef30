// Builds conditions (QueryExpression of ISO 19143). The gateway's docs/conditions.md defines their meaning.
import { element, text_element } from './xml.js';

/** A predicate with an optional order. */
export class Condition {
  constructor(
    /** A predicate as XML, with the prefixes `fes` and `gml`; empty: matches all. */
    readonly predicate: string,
    /** SortProperty elements as XML. */
    readonly order: string = '',
  ) {}

  /** A copy sorted by this key, after the keys of earlier calls. */
  sorted_by(by: Expression | string, order: 'ASC' | 'DESC' = 'ASC'): Condition {
    const key = element('fes:SortProperty', {}, typeof by === 'string' ? property(by).xml : by.xml, text_element('fes:SortOrder', order));
    return new Condition(this.predicate, this.order + key);
  }

  /** A copy that also requires `other`. */
  and(other: Condition): Condition {
    return new Condition(all_of(this, other).predicate, this.order);
  }

  /** The content of a message's `condition`. */
  get xml(): string {
    const filter = this.predicate === '' ? '' : element('fes:Filter', {}, this.predicate);
    return filter + (this.order === '' ? '' : element('fes:SortBy', {}, this.order));
  }
}

/** A condition given as XML: the content of `condition`, with the prefixes `fes`, `gml`, `unr` and `rois`. */
export class WrittenCondition {
  constructor(readonly xml: string) {}
}

/** Matches all, for `everything.sorted_by(...)`. */
export const everything = new Condition('');

/** An operand of a comparison. */
export class Expression {
  constructor(readonly xml: string) {}
}

/** A point or a box. */
export class Geometry extends Expression {}

/** A point in mm. Without `crs`, it is in the frame of the value that it is compared with. */
export function point(x: number, y: number, crs?: string): Geometry {
  return new Geometry(element('gml:Point', { srsName: crs }, text_element('gml:pos', `${x} ${y}`)));
}

/** A box parallel to the axes, in mm. */
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

/** The distance between two positions or named places, in mm. */
export function distance(from: Expression | string, to: Operand): Expression {
  const argument = (of: Operand) => (of instanceof Geometry ? element('fes:Literal', {}, of.xml) : operand(of));
  return new Expression(
    element('fes:Function', { name: 'distance' }, argument(typeof from === 'string' ? property(from) : from), argument(to)),
  );
}

/** A literal (also the name of a place), a time, or an expression. */
export type Operand = string | number | boolean | Date | Expression;

function operand(of: Operand): string {
  if (of instanceof Expression) return of.xml;
  return text_element('fes:Literal', of instanceof Date ? of.toISOString() : String(of));
}

function instant(time: Date): string {
  return element('gml:TimeInstant', {}, text_element('gml:timePosition', time.toISOString()));
}

/** How a comparison treats several values, and whether it is case-sensitive. */
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

  /** Including both boundaries. */
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

  /** `*` matches any text, `?` one character; `\` escapes them. */
  like(pattern: string, how: { match_case?: boolean } = {}): Condition {
    const marks = { wildCard: '*', singleChar: '?', escapeChar: '\\', matchCase: how.match_case };
    return new Condition(element('fes:PropertyIsLike', marks, this.xml, text_element('fes:Literal', pattern)));
  }

  /** True if the property has no value. */
  is_null(): Condition {
    return new Condition(element('fes:PropertyIsNull', {}, this.xml));
  }

  /** True inside a box or a named place. */
  within(area: Operand): Condition {
    return this.related('Within', area);
  }
  intersects(area: Operand): Condition {
    return this.related('Intersects', area);
  }
  disjoint_from(area: Operand): Condition {
    return this.related('Disjoint', area);
  }

  /** True up to this distance from a point, box or named place. */
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

  /** Excluding the ends of the period. */
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

/** Components of this type: a name such as `Navigation`, or a URN. */
export function component_type(type: string): Condition {
  return property('component_type').equals(type_urn(type));
}

/** The URN of a component type. A name without colon is a type of the specification. */
export function type_urn(type: string): string {
  return type.includes(':') ? type : `urn:x-rois:def:component:OMG::${type}`;
}

/** Only this component. */
export function component_ref(code: string): Condition {
  return property('component_ref').equals(code);
}

/** Ignores the orders of the conditions, as do `any_of` and `not`. */
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
