import assert from 'node:assert/strict';
import { createHash } from 'node:crypto';
import { createServer, type Socket } from 'node:net';
import { test } from 'node:test';

import { frame, FrameError, FrameReader, most_bytes, Opcode } from '#dist/node_frames.js';
import { open_node_socket } from '#dist/node_socket.js';

// A server's frame: not masked.
function sent(opcode: number, payload: Buffer | string, final = true): Buffer {
  const bytes = Buffer.from(payload);
  const head = Buffer.alloc(bytes.length < 126 ? 2 : bytes.length < 65536 ? 4 : 10);
  head[0] = (final ? 0x80 : 0) | opcode;
  head[1] = bytes.length < 126 ? bytes.length : bytes.length < 65536 ? 126 : 127;
  if (head.length === 4) head.writeUInt16BE(bytes.length, 2);
  if (head.length === 10) head.writeBigUInt64BE(BigInt(bytes.length), 2);
  return Buffer.concat([head, bytes]);
}

function read(...pieces: Buffer[]): string[] {
  const calls: string[] = [];
  const reader = new FrameReader({
    text: (message) => calls.push(message.length > 100 ? `${message.length}` : message),
    ping: (payload) => calls.push(`ping ${payload}`),
    close: (code, reason) => calls.push(`close ${code} ${reason}`),
  });
  for (const piece of pieces) reader.feed(piece);
  return calls;
}

test('messages are assembled from any chunks', () => {
  const all = Buffer.concat([
    sent(Opcode.text, 'one'),
    sent(Opcode.text, 'お'),
    sent(Opcode.text, 'x'.repeat(125)),
    sent(Opcode.text, 'x'.repeat(126)),
    sent(Opcode.text, 'x'.repeat(70_000)),
    sent(Opcode.text, 'two ', false),
    sent(Opcode.ping, 'a'),
    sent(Opcode.continuation, 'parts'),
    sent(Opcode.text, ''),
    sent(Opcode.pong, ''),
    sent(Opcode.close, Buffer.from([0x03, 0xe9, 0x6f, 0x6b])),
    sent(Opcode.text, 'ignored after close'),
  ]);
  const expected = ['one', 'お', '125', '126', '70000', 'ping a', 'two parts', '', 'close 1001 ok'];
  assert.deepEqual(read(all), expected);
  assert.deepEqual(read(...Array.from(all, (byte) => Buffer.from([byte]))), expected);
  for (let at = 1; at < 400; ++at) assert.deepEqual(read(all.subarray(0, at), all.subarray(at)), expected);
});

test('each protocol violation has its close code', () => {
  const bad: [Buffer, number][] = [
    [Buffer.from([0xc1, 0]), 1002], // reserved bit
    [Buffer.from([0x81, 0x80, 0, 0, 0, 0]), 1002], // masked
    [Buffer.from([0x83, 0]), 1002], // unknown opcode
    [Buffer.from([0x09, 0]), 1002], // fragmented ping
    [sent(Opcode.ping, 'x'.repeat(126)), 1002],
    [sent(Opcode.close, 'x'), 1002],
    [sent(Opcode.continuation, 'x'), 1002],
    [Buffer.concat([sent(Opcode.text, 'x', false), sent(Opcode.text, 'y')]), 1002],
    [sent(Opcode.binary, 'x'), 1003],
    [sent(Opcode.text, Buffer.from([0xff])), 1007],
    [Buffer.from([0x81, 127, 0xff, 0, 0, 0, 0, 0, 0, 0]), 1009],
    [Buffer.from([0x81, 127, 0, 0, 0, 0, ...[24, 16, 8, 0].map((shift) => ((most_bytes + 1) >> shift) & 255)]), 1009],
  ];
  for (const [bytes, code] of bad) assert.throws(() => read(bytes), (error) => error instanceof FrameError && error.code === code, bytes.toString('hex'));
});

test("a client's frame is masked and has the right length", () => {
  for (const size of [0, 125, 126, 65535, 65536]) {
    const bytes = frame(Opcode.text, Buffer.alloc(size, 'x'));
    const head = size < 126 ? 2 : size < 65536 ? 4 : 10;
    assert.equal(bytes.length, head + 4 + size);
    assert.equal(bytes[0], 0x81);
    assert.equal(bytes[1], 0x80 | (head === 2 ? size : head === 4 ? 126 : 127));
    if (size > 0) assert.equal(bytes[head + 4]! ^ bytes[head]!, 'x'.charCodeAt(0));
  }
});

// Starts a server with this handshake and these bytes. Returns the calls of the listener.
async function calls_of(answer: (accept: string) => string | Buffer, speak: (socket: Socket) => void = () => undefined): Promise<string[]> {
  const sockets = new Set<Socket>();
  const server = createServer((socket) => {
    sockets.add(socket);
    socket.on('error', () => undefined);
    socket.once('data', (head) => {
      const key = /sec-websocket-key: *(\S+)/i.exec(head.toString())![1]!;
      socket.write(answer(createHash('sha1').update(`${key}258EAFA5-E914-47DA-95CA-C5AB0DC85B11`).digest('base64')));
      speak(socket);
    });
  }).listen(0, '127.0.0.1');
  await new Promise((resolve) => server.once('listening', resolve));
  const calls: string[] = [];
  await new Promise<void>((resolve) => {
    open_node_socket(`ws://127.0.0.1:${(server.address() as { port: number }).port}/rois`, ['rois.xml.v1'], {
      opened: () => calls.push('opened'),
      received: (text) => calls.push(text),
      ended: ({ reason, final }) => {
        calls.push(`${final ? 'final: ' : ''}${reason}`);
        resolve();
      },
    });
  });
  for (const socket of sockets) socket.destroy();
  server.close();
  return calls;
}

const welcome = (accept: string, protocol = 'rois.xml.v1') =>
  `HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Accept: ${accept}\r\nSec-WebSocket-Protocol: ${protocol}\r\n\r\n`;

test('a socket reports messages, also those sent with the handshake, and its end', async () => {
  const calls = await calls_of(
    (accept) => Buffer.concat([Buffer.from(welcome(accept)), sent(Opcode.text, 'at once')]),
    (socket) => socket.write(Buffer.concat([sent(Opcode.text, 'later'), sent(Opcode.close, Buffer.from([0x03, 0xe9]))])),
  );
  assert.deepEqual(calls, ['opened', 'at once', 'later', 'the gateway closed the link with 1001']);
});

test('a socket reports a broken connection', async () => {
  assert.deepEqual(await calls_of(welcome, (socket) => socket.end()), ['opened', 'the link broke']);
});

test('a socket answers pings, and closes on a protocol violation', async () => {
  let received = Buffer.alloc(0);
  const calls = await calls_of(welcome, (socket) => {
    socket.write(sent(Opcode.ping, 'abc'));
    socket.on('data', (bytes) => {
      const first = received.length === 0;
      received = Buffer.concat([received, bytes]);
      if (first) socket.write(sent(Opcode.binary, 'x'));
    });
  });
  assert.deepEqual(calls, ['opened', 'the gateway violates the WebSocket protocol: a binary message; only text is expected']);
  assert.deepEqual([received[0], received[1]], [0x8a, 0x83]);
  assert.equal(received[6]! ^ received[2]!, 'a'.charCodeAt(0));
});

test('a server that sends pings and does not read does not make the client grow', async () => {
  const pings = 200_000;
  const many = Buffer.concat(Array.from({ length: 1_000 }, () => sent(Opcode.ping, 'x'.repeat(125))));
  let received = 0;
  await calls_of(welcome, (socket) => {
    socket.pause();
    let written = 0;
    const more = () => {
      let room = true;
      for (; written < pings && room; written += 1_000) room = socket.write(many);
      if (written < pings) socket.once('drain', more);
      else socket.end(() => socket.on('data', (bytes) => (received += bytes.length)).resume());
    };
    more();
  });
  assert.ok(received > 0);
  assert.ok(received < (pings * 131) / 2, `${received} bytes waited in the client`);
});

test('an invalid handshake is final', async () => {
  const wrong = ['final: the server does not speak rois.xml.v1'];
  assert.deepEqual(await calls_of(() => welcome('bm90IHJpZ2h0')), wrong);
  assert.deepEqual(await calls_of((accept) => welcome(accept, 'rois.xml.v2')), wrong);
  const refusal = (status: string) => () => `HTTP/1.1 ${status}\r\nContent-Length: 2\r\nConnection: close\r\n\r\nno`;
  assert.deepEqual(await calls_of(refusal('401 Unauthorized')), ['final: the gateway answered 401: no']);
  assert.deepEqual(await calls_of(refusal('503 Service Unavailable')), ['the gateway answered 503: no'], 'a retry may succeed');
});
