import assert from 'node:assert/strict';
import { test } from 'node:test';

import { answer_text, RoisError } from 'rois-client';

test('the text of an answer has 4,000,000 bytes at most', async () => {
  const longest = 'é'.repeat(2_000_000);
  assert.equal(await answer_text(new Response(longest)), longest);
  await assert.rejects(
    answer_text(new Response(`${longest}x`)),
    (error) => error instanceof RoisError && /longer than 4000000 bytes/.test(error.message),
  );
});

test('an answer without a body has an empty text', async () => {
  assert.equal(await answer_text(new Response(null, { status: 204 })), '');
});
