import assert from 'node:assert/strict';
import { test } from 'node:test';

import { type Parameter, pose_of, pose_text, Results, value } from 'rois-client';

const one = (name: string, code: string, ...values: string[]): Parameter => ({ name, data_type_ref: { code }, values });

test('values are written by their types', () => {
  assert.deepEqual([-3.7, 2.4, -0.2].map((n) => value.int(n).values[0]), ['-4', '2', '0']);
  assert.deepEqual(value.double(0.5).values, ['0.5']);
  assert.deepEqual([NaN, Infinity, -Infinity].map((n) => value.double(n).values[0]), ['NaN', 'INF', '-INF']);
  assert.deepEqual(value.bool(false).values, ['false']);
  assert.deepEqual(value.date_time(new Date(0)).values, ['1970-01-01T00:00:00.000Z']);
  assert.deepEqual(value.ints([1.4, -1.6]), { data_type_ref: { code: 'int[]' }, values: ['1 -2'] });
  assert.deepEqual(value.bools([true, false]).values, ['true false']);
  assert.deepEqual(value.strings([]), { data_type_ref: { code: 'string[]' }, values: [] });
  assert.deepEqual(value.identifier({ code: 'wave', codebook_ref: 'urn:g' }), {
    data_type_ref: { code: 'RoISIdentifier', codebook_ref: 'urn:g' },
    values: ['wave'],
  });
});

test('results are parsed by their types', () => {
  const results = new Results([
    one('number', 'int', ' 3 '),
    one('Names', 'string[]', 'a b', 'c'),
    one('line', 'urn:x-rois:def:DataType:OMG::int[]', '1 2  3'),
    one('is_final', 'bool', 'true'),
    one('time', 'DateTime', '2026-11-20T12:00:00.123Z'),
    one('position_data', 'string[]', '1, -2, 3.5', 'desk', '4,5'),
    one('far', 'double', '-INF'),
  ]);
  assert.equal(results.number('number'), 3);
  assert.deepEqual(results.texts('names'), ['a b', 'c']);
  assert.deepEqual(results.numbers('line'), [1, 2, 3]);
  assert.equal(results.bool('is_final'), true);
  assert.equal(results.time('time')!.getTime(), Date.UTC(2026, 10, 20, 12, 0, 0, 123));
  assert.deepEqual(results.poses('position_data'), [{ x: 1, y: -2, th: 3.5 }, { x: 4, y: 5, th: 0 }]);
  assert.equal(results.number('far'), -Infinity);
  assert.deepEqual([results.text('x'), results.number('x'), results.bool('x'), results.time('x')], [undefined, undefined, undefined, undefined]);
  assert.equal(results.number('names'), undefined);
});

test('poses are parsed and written', () => {
  assert.deepEqual(pose_of(pose_text({ x: 1.5, y: -2, th: 90 })), { x: 1.5, y: -2, th: 90 });
  for (const text of ['', 'desk', '1', '1, 2, 3, 4', '1, ,2', '1, x']) assert.equal(pose_of(text), undefined, text);
});
