// Reads a condition from XML. Predicates without fields in the form stay XML.
import { parse_xml, type XmlElement } from 'rois-client';

import {
  type Area,
  type Draft,
  new_area,
  new_draft,
  new_group,
  new_predicate,
  new_sort_key,
  new_written,
  type Group,
  type Node,
  type Operator,
  type Predicate,
  type SortKey,
} from './model';
import { text_of_element, wrapped } from './xml_writing';

/** Reads a Filter, a predicate, a `condition` or a request. Throws XmlError if it is not XML, and Error if it is not a condition. */
export function draft_read(text: string): Draft {
  const root = parsed(text);
  const purpose = root.name === 'subscribe' || root.name === 'query' || root.name === 'bind_any' ? root.name : 'search';
  const condition = root.name === 'condition' ? root : (root.child('condition') ?? (is_request(root) ? undefined : root));
  const filter = condition?.child('Filter');
  const order = condition?.child('SortBy');
  const predicates = filter?.children ?? (order ? [] : (condition?.children ?? []));
  if (condition && predicates.length === 0 && !order && condition.children.length > 0) throw new Error('no Filter');
  if (predicates.some((one) => one.name === 'SearchCondition')) throw new Error('SearchCondition');
  return {
    ...new_draft(),
    purpose,
    event_type: root.text_of('event_type').trim(),
    query_type: root.text_of('query_type').trim(),
    inline_results: /^(true|1)$/.test(root.attribute('inline_results') ?? 'true'),
    root: root_of(predicates.map(node_of)),
    order: (order?.all('SortProperty') ?? []).map(sort_key_of).filter((one): one is SortKey => one !== undefined),
  };
}

// A document, or a fragment with the usual prefixes.
function parsed(text: string): XmlElement {
  try {
    const root = parse_xml(text);
    if (is_request(root) || root.name === 'condition') return root;
    const around = parse_xml(wrapped(''));
    around.children.push(root);
    return around;
  } catch (error) {
    try {
      return parse_xml(wrapped(text));
    } catch {
      throw error;
    }
  }
}

function is_request({ name }: XmlElement): boolean {
  return /^(search|bind_any|get_profile|subscribe|query|get_event_detail|get_command_result|get_error_detail)$/.test(name);
}

function root_of(nodes: Node[]): Group {
  const [first] = nodes;
  return nodes.length === 1 && first?.kind === 'group' ? first : new_group(nodes);
}

function node_of(one: XmlElement): Node {
  if (one.name === 'And' || one.name === 'Or') return new_group(one.children.map(node_of), one.name);
  if (one.name === 'Not' && one.children.length === 1) {
    const inner = node_of(one.children[0]!);
    return { ...inner, is_not: !inner.is_not };
  }
  const read = predicate_of(one);
  return read ? new_predicate(read) : new_written(text_of_element(one));
}

function predicate_of(one: XmlElement): Partial<Predicate> | undefined {
  const [first, ...others] = one.children;
  if (first?.name !== 'ValueReference') return undefined;
  const reference = first.text.trim();
  const operator = one.name.replace(/^PropertyIs/, '').replace('BBOX', 'Intersects') as Operator;
  const [second] = others;
  switch (operator) {
    case 'EqualTo': case 'NotEqualTo': case 'LessThan': case 'GreaterThan': case 'LessThanOrEqualTo': case 'GreaterThanOrEqualTo': {
      const matching = (one.attribute('matchAction') ?? 'Any') as Predicate['matching'];
      return others.length === 1 && literal(second) !== undefined
        ? { reference, operator, value: literal(second)!, matching, match_case: minds_case(one) }
        : undefined;
    }
    case 'Like':
      return is_usual_pattern(one) && literal(second) !== undefined
        ? { reference, operator, value: literal(second)!, match_case: minds_case(one) }
        : undefined;
    case 'Null':
      return { reference, operator };
    case 'Between': {
      const [value, upper] = [literal(one.child('LowerBoundary')?.child('Literal')), literal(one.child('UpperBoundary')?.child('Literal'))];
      return value === undefined || upper === undefined ? undefined : { reference, operator, value, upper };
    }
    case 'Within': case 'Intersects': case 'Disjoint': case 'DWithin': case 'Beyond': {
      const area = second && area_of(second);
      const distance = one.child('Distance');
      if (!area || (distance === undefined) !== (operator !== 'DWithin' && operator !== 'Beyond')) return undefined;
      return distance ? { reference, operator, area, distance: millimetres(distance) } : { reference, operator, area };
    }
    case 'After': case 'Before': {
      const value = second?.name === 'TimeInstant' ? time(second.text_of('timePosition')) : undefined;
      return value === undefined ? undefined : { reference, operator, value };
    }
    case 'During': {
      const [value, upper] = [time(second?.text_of('beginPosition')), time(second?.text_of('endPosition'))];
      return value === undefined || upper === undefined ? undefined : { reference, operator, value, upper };
    }
    default:
      return undefined;
  }
}

function literal(one: XmlElement | undefined): string | undefined {
  return one?.name === 'Literal' && one.children.length === 0 ? one.text.trim() : undefined;
}

function minds_case(one: XmlElement): boolean {
  return !/^(false|0)$/.test(one.attribute('matchCase') ?? 'true');
}

function is_usual_pattern(one: XmlElement): boolean {
  return one.attribute('wildCard') === '*' && one.attribute('singleChar') === '?' && one.attribute('escapeChar') === '\\';
}

// Only complete times: 2026 is a period with another meaning.
function time(text = ''): string | undefined {
  return /T/.test(text) && !Number.isNaN(new Date(text.trim()).getTime()) ? new Date(text.trim()).toISOString() : undefined;
}

function area_of(one: XmlElement): Area | undefined {
  const crs = one.attribute('srsName') ?? '';
  const place = literal(one);
  if (place !== undefined) return { ...new_area('place'), place };
  const numbers = (of: XmlElement | undefined) => (of?.text ?? '').trim().split(/\s+/);
  if (one.name === 'Literal' && one.children.length === 1) return area_of(one.children[0]!);
  if (one.name === 'Point') {
    const [x, y, ...more] = numbers(one.child('pos'));
    return x && y && more.length === 0 ? { ...new_area('point'), x, y, crs } : undefined;
  }
  const [low, high] = one.child('lowerCorner') ? [one.child('lowerCorner'), one.child('upperCorner')] : one.all('pos');
  const [[x, y, ...above], [x2, y2]] = [numbers(low), numbers(high)];
  return one.name === 'Envelope' && x && y && x2 && y2 && above.length === 0 ? { ...new_area('box'), x, y, x2, y2, crs } : undefined;
}

const in_millimetres: Record<string, number> = {
  mm: 1,
  millimetre: 1,
  millimeter: 1,
  cm: 10,
  centimetre: 10,
  centimeter: 10,
  m: 1000,
  metre: 1000,
  meter: 1000,
  km: 1e6,
  kilometre: 1e6,
  kilometer: 1e6,
};

function millimetres(distance: XmlElement): string {
  return String(Number(distance.text) * (in_millimetres[distance.attribute('uom') ?? 'mm'] ?? NaN));
}

function sort_key_of(one: XmlElement): SortKey | undefined {
  const order = one.text_of('SortOrder').trim() === 'DESC' ? 'DESC' : 'ASC';
  const by = one.child('Function');
  if (!by) return new_sort_key({ reference: one.text_of('ValueReference').trim(), order });
  const [from, to] = by.children;
  const area = to && area_of(to);
  return from?.name === 'ValueReference' && area ? new_sort_key({ by: 'distance', reference: from.text.trim(), area, order }) : undefined;
}
