import assert from 'node:assert/strict';
import { test } from 'node:test';

import { open_browser_socket } from '#dist/browser_socket.js';

test('a message that is not a text, or longer than 64 MiB, closes the socket', () => {
  const closed: number[] = [];
  const received: string[] = [];
  class Scripted {
    onmessage!: (event: { data: unknown }) => void;
    constructor() {
      made = this;
    }
    close(code: number) {
      closed.push(code);
    }
  }
  let made!: Scripted;
  const before = globalThis.WebSocket;
  globalThis.WebSocket = Scripted as never;
  try {
    open_browser_socket('ws://127.0.0.1', [], { opened() {}, received: (text) => received.push(text), ended() {} });
  } finally {
    globalThis.WebSocket = before;
  }
  for (const data of ['<a/>', new ArrayBuffer(1), 'x'.repeat(64 * 1024 * 1024 + 1)]) made.onmessage({ data });
  assert.deepEqual(received, ['<a/>']);
  assert.deepEqual(closed, [4000, 4000]);
});
