// The reception scenario in each language on the same simulated day: equal histories.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';

import { connect } from 'rois-client';

import { Gateway, root } from '../kit/gateway.js';
import { output_of } from '../kit/program.js';
import { Proxy, random_from } from '../kit/proxy.js';

const data = `${root}/tests/server/data`;
const history = readFileSync(`${data}/three_visitors.txt`, 'utf8');

const programs: [name: string, source: string, command: string[]][] = [
  ['TypeScript', 'web/client/examples/reception.ts', [process.execPath, `${root}/web/client/build/examples/reception.js`]],
  ['Python', 'docs/examples/reception.py', ['python3', `${root}/docs/examples/reception.py`]],
  ['a shell with curl', 'docs/examples/reception.sh', ['sh', `${root}/docs/examples/reception.sh`]],
];

async function received_by(command: string[], cuts: number): Promise<string> {
  const gateway = await Gateway.start('--floor-plan', `${data}/watchful_hall.xml`, '--scenario', `${data}/three_visitors.xml`, '--sim-speed', '20', '--seed', '7');
  const proxy = await Proxy.before(gateway.port);
  proxy.cut_at_random(cuts, 5_000, random_from(3));
  try {
    const output = await output_of([...command, '3'], proxy.url);
    assert.equal(proxy.cuts, cuts);
    return output;
  } finally {
    await proxy.stop();
    await gateway.stop();
  }
}

test('the reception has the same history in every language', { concurrency: true }, async (all) => {
  const each = programs.flatMap(([name, , command]) => [
    all.test(`in ${name}`, async () => assert.equal(await received_by(command, 0), history)),
    all.test(`in ${name}, while the link is cut`, async () => assert.equal(await received_by(command, 10), history)),
  ]);
  await Promise.all(each);
});

const [, , in_typescript] = programs[0]!;

test('the reception in TypeScript rejects an invalid number of visitors in one line', async () => {
  const ends = ['abc', '0', '-3', '2abc', '1.5', '1000000', ''].map((visitors) =>
    assert.rejects(output_of([...in_typescript, visitors], 'http://127.0.0.1:1'), {
      message: `it ended with 1: reception: VISITORS is a whole number, 1 to 999999, not '${visitors}'\n`,
    }),
  );
  await Promise.all(ends);
});

test('the reception in TypeScript reports in one line why it cannot start, and ends its session', async () => {
  const gateway = await Gateway.start('--scenario', `${data}/empty_hall.xml`);
  try {
    const other = await connect(gateway.url);
    await other.bind('navigation');
    await assert.rejects(output_of(in_typescript, gateway.url), { message: /^it ended with 1: reception: bind_any: .*\n$/ });
    await other.bind('person_detection'); // bound by the failed program before
    await other.close();
    await assert.rejects(output_of(in_typescript, `${gateway.url}/nowhere`), { message: /^it ended with 1: reception: .*\n$/ });
  } finally {
    await gateway.stop();
  }
});

test('the reception is shorter than 100 lines', () => {
  for (const [, source] of programs.filter(([name]) => name !== 'a shell with curl'))
    assert.ok(readFileSync(`${root}/${source}`, 'utf8').split('\n').length - 1 < 100, source);
});
