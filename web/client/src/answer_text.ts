// Answers to plain HTTP requests. Whoever answers may not be a gateway, so their length is limited.
import { RoisError } from './errors.js';

const longest = 4_000_000; // bytes of an answer

/** Returns the text of an answer. Rejects with RoisError `protocol` if it is longer than 4,000,000 bytes. */
export async function answer_text(answer: Response): Promise<string> {
  const reader = answer.body?.getReader();
  const decoder = new TextDecoder();
  let text = '';
  let length = 0;
  for (let piece = await reader?.read(); piece?.value !== undefined; piece = await reader?.read()) {
    text += decoder.decode(piece.value, { stream: true });
    length += piece.value.length;
    if (length <= longest) continue;
    await reader?.cancel();
    throw new RoisError('protocol', `the answer is longer than ${longest} bytes`);
  }
  return text;
}
