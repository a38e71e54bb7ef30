// Replays the dialogue of docs/clients.md byte by byte and compares the answers.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { connect, type Socket } from 'node:net';
import { test } from 'node:test';

import { frame, FrameReader, Opcode } from '#dist/node_frames.js';

import { Gateway, root } from '../kit/gateway.js';

const page = readFileSync(`${root}/docs/clients.md`, 'utf8');
const blocks = [...page.matchAll(/^```(http|text)\n([^]*?)^```$/gm)].map(([, kind, text]) => ({ kind: kind!, text: text! }));

// The bytes on the wire: header lines end in CR LF, a body has no line end.
function bytes(block: string): string {
  const end = block.indexOf('\n\n');
  return `${block.slice(0, end).replaceAll('\n', '\r\n')}\r\n\r\n${block.slice(end + 2).replace(/\n$/, '')}`;
}

// Reads from a socket until `enough` accepts the text.
async function until(socket: Socket, enough: (text: string) => boolean): Promise<string> {
  let text = '';
  while (!enough(text)) {
    const piece = socket.read() as Buffer | null;
    if (piece) text += piece.toString();
    else if (socket.readableEnded) return text;
    else await new Promise((resolve) => socket.once('readable', resolve).once('end', resolve));
  }
  return text;
}

// Whether `length` bytes have arrived.
const whole = (length: number) => (text: string) => Buffer.byteLength(text) >= length;

// Replaces the parts that differ each time.
const steady = (text: string) => text.replace(/^Date: .*$/m, 'Date: N').replace(/<expire>[^<]*/, '<expire>N');

test('the documented dialogue is what the gateway answers', async () => {
  const gateway = await Gateway.start('--scenario', `${root}/tests/server/data/empty_hall.xml`, '--sim-speed', '50');
  const shown_session = /<session>(.*)<\/session>/.exec(page)![1]!;
  let session = shown_session;
  const at_the_gateway = (text: string) => text.replaceAll(shown_session, session);
  const as_shown = (text: string) => steady(text.replaceAll(session, shown_session));
  let played = 0;
  const open = () => connect(gateway.port, '127.0.0.1');
  let socket = open();

  const ask = async (request: string, answer: string | undefined): Promise<void> => {
    if (request.includes('last_sequence') || request.includes('notifications')) await completed();
    if (socket.readableEnded || request.includes('event-stream') || request.includes('Upgrade')) {
      socket.destroy();
      socket = open();
    }
    socket.write(at_the_gateway(bytes(request)));
    if (answer === undefined) {
      assert.match(await until(socket, (text) => text.includes('</execute_response>')), /return_code="OK"/);
      return;
    }
    const expected = bytes(answer) + (answer.includes('event-stream') ? '\n' : '');
    const came = await until(socket, whole(Buffer.byteLength(expected)));
    session = /^RoIS-Session: (.*)\r$/m.exec(came)?.[1] ?? session;
    assert.equal(as_shown(came), steady(expected));
    played += 1;
  };

  // Until all commands have completed.
  const completed = async (): Promise<void> => {
    for (let news = ''; !news.includes('<completed'); )
      news = await (await fetch(`${gateway.url}/rois/notifications?after=1&wait=30`, { headers: { 'RoIS-Session': session } })).text();
  };

  const websocket = async (lines: string): Promise<void> => {
    const came: string[] = [];
    let wake = (): void => undefined;
    const reader = new FrameReader({ text: (message) => came.push(message) && wake(), ping: () => undefined, close: () => undefined });
    socket.on('data', (piece) => reader.feed(piece));
    for (const line of lines.trimEnd().split('\n')) {
      if (line.startsWith('> ')) {
        socket.write(frame(Opcode.text, Buffer.from(at_the_gateway(line.slice(2)))));
        continue;
      }
      while (came.length === 0) await new Promise<void>((resolve) => (wake = resolve));
      assert.equal(as_shown(came.shift()!), line.slice(2));
    }
    assert.deepEqual(came, []);
    played += 1;
  };

  try {
    for (const [i, { kind, text }] of blocks.entries()) {
      const next = blocks[i + 1]?.text;
      if (kind === 'text') await websocket(text);
      else if (!text.startsWith('HTTP/')) await ask(text, next?.startsWith('HTTP/') ? next : undefined);
    }
    assert.equal(played, 8, 'connect, bind, fault, subscribe, poll, stream, handshake, WebSocket');
  } finally {
    socket.destroy();
    await gateway.stop();
  }
});

test('the documented frame is correct', () => {
  const [, mask, begin] = /with the mask `([0-9a-f ]+)`, the `connect` above begins with `([0-9a-f ]+)`/.exec(page)!;
  const body = '<connect xmlns="urn:x-rois:psm:xml:message:1"/>';
  assert.ok(page.includes(`\n${body}\n`));
  const key = Buffer.from(mask!.replaceAll(' ', ''), 'hex');
  const own = frame(Opcode.text, Buffer.from(body));
  const masked = Buffer.from(body).map((byte, i) => byte ^ key[i % 4]!);
  const shown = Buffer.concat([own.subarray(0, 2), key, masked]).toString('hex');
  assert.ok(shown.startsWith(begin!.replaceAll(' ', '')), shown.slice(0, 40));
});
