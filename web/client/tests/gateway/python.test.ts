// Python's example client, cut 100 times: misses nothing without a gap, receives nothing twice, executes nothing twice.
import assert from 'node:assert/strict';
import { createServer } from 'node:net';
import { test } from 'node:test';

import { Gateway, root } from '../kit/gateway.js';
import { output_of } from '../kit/program.js';
import { Proxy, random_from } from '../kit/proxy.js';

test('in Python, 100 cuts lose nothing of 10,000 events and 500 commands', async () => {
  const gateway = await Gateway.start('--scenario', `${root}/tests/server/data/empty_hall.xml`, '--sim-speed', '100');
  const proxy = await Proxy.before(gateway.port);
  try {
    proxy.cut_at_random(100, 50_000, random_from(11));
    const came = JSON.parse(await output_of(['python3', `${root}/tests/clients/endurance.py`], proxy.url));
    assert.equal(proxy.cuts, 100);
    assert.deepEqual(came, { statuses: { OK: 500 }, in_order: true, events: 10_000, completed: 500, completed_twice: [], lost: 0 });
  } finally {
    await proxy.stop();
    await gateway.stop();
  }
});

// Python's library takes truncated headers for a response without a body.
test('in Python, an answer that is cut off in its headers or body is requested again', async () => {
  const body = '<connect_response xmlns="urn:x-rois:psm:xml:message:1" return_code="OK"><session>whole</session></connect_response>';
  const answer = `HTTP/1.1 200 OK\r\nContent-Type: application/xml\r\nContent-Length: ${body.length}\r\n\r\n${body}`;
  const lengths = [30, answer.length - 20, answer.length];
  const server = createServer((socket) => {
    socket.on('error', () => undefined);
    socket.once('data', () => socket.end(answer.slice(0, lengths.shift())));
  }).listen(0, '127.0.0.1');
  await new Promise((resolve) => server.once('listening', resolve));
  const program = `import os, sys; sys.path.insert(0, sys.argv[1]); from rois import Engine; print(Engine(os.environ["ROIS_URL"]).session)`;
  const url = `http://127.0.0.1:${(server.address() as { port: number }).port}`;
  const came = await output_of(['python3', '-c', program, `${root}/docs/examples`], url).finally(() => server.close());
  assert.equal(came, 'whole\n');
  assert.deepEqual(lengths, []);
});
