// WebSocket frames (RFC 6455) of the client side: bytes to messages and back. Does no I/O.
import { randomBytes } from 'node:crypto';

export const most_bytes = 64 * 1024 * 1024; // of a message

export const enum Opcode {
  continuation = 0,
  text = 1,
  binary = 2,
  close = 8,
  ping = 9,
  pong = 10,
}

/** A protocol violation. The link must be closed with this code. */
export class FrameError extends Error {
  constructor(
    what: string,
    readonly code: 1002 | 1003 | 1007 | 1009,
  ) {
    super(what);
  }
}

/** Encodes one frame, masked as RFC 6455 requires of a client. */
export function frame(opcode: Opcode, payload: Uint8Array): Buffer {
  const size = payload.length;
  const head = size < 126 ? 2 : size < 65536 ? 4 : 10;
  const out = Buffer.allocUnsafe(head + 4 + size);
  out[0] = 0x80 | opcode;
  if (head === 2) {
    out[1] = 0x80 | size;
  } else if (head === 4) {
    out[1] = 0x80 | 126;
    out.writeUInt16BE(size, 2);
  } else {
    out[1] = 0x80 | 127;
    out.writeBigUInt64BE(BigInt(size), 2);
  }
  const mask = randomBytes(4);
  mask.copy(out, head);
  for (let i = 0; i < size; ++i) out[head + 4 + i] = payload[i]! ^ mask[i & 3]!;
  return out;
}

export interface FrameListener {
  text(message: string): void;
  ping(payload: Buffer): void;
  close(code: number | undefined, reason: string): void;
}

/** Assembles messages from received bytes. Chunks may end anywhere. */
export class FrameReader {
  private chunks: Buffer[] = []; // received and not parsed
  private size = 0; // bytes in chunks
  private needed = 2; // bytes needed for the next step
  private fragments: Buffer[] = []; // of the unfinished message
  private fragments_size = 0;
  private in_message = false;
  private ended = false;

  constructor(private readonly listener: FrameListener) {}

  /** Passes each complete message to the listener. Throws FrameError if the server violates the protocol. */
  feed(bytes: Buffer): void {
    this.chunks.push(bytes);
    this.size += bytes.length;
    while (!this.ended && this.size >= this.needed && this.step());
  }

  // Parses one frame if it is complete.
  private step(): boolean {
    const all = this.chunks.length === 1 ? this.chunks[0]! : Buffer.concat(this.chunks, this.size);
    this.chunks = [all];
    const short = all[1]! & 0x7f;
    const head = short < 126 ? 2 : short === 126 ? 4 : 10;
    if (this.misses(head)) return false;
    const long = head === 2 ? BigInt(short) : head === 4 ? BigInt(all.readUInt16BE(2)) : all.readBigUInt64BE(2);
    this.check(all[0]!, all[1]!, long);
    const end = head + Number(long);
    if (this.misses(end)) return false;
    this.chunks = end === all.length ? [] : [all.subarray(end)];
    this.size -= end;
    this.needed = 2;
    this.take(all[0]! & 15, (all[0]! & 0x80) !== 0, all.subarray(head, end));
    return true;
  }

  private misses(bytes: number): boolean {
    this.needed = bytes;
    return this.size < bytes;
  }

  private check(first: number, second: number, size: bigint): void {
    const opcode = first & 15;
    if ((first & 0x70) !== 0) throw new FrameError('a reserved bit is set in a frame', 1002);
    if ((second & 0x80) !== 0) throw new FrameError("a server's frame is masked", 1002);
    if (opcode >= 8 && ((first & 0x80) === 0 || size > 125n))
      throw new FrameError('a control frame is fragmented or longer than 125 bytes', 1002);
    if (opcode < 8 && BigInt(this.fragments_size) + size > BigInt(most_bytes))
      throw new FrameError(`a message has more than ${most_bytes} bytes`, 1009);
  }

  private take(opcode: number, final: boolean, payload: Buffer): void {
    switch (opcode) {
      case Opcode.continuation:
      case Opcode.text:
        if ((opcode === Opcode.continuation) !== this.in_message)
          throw new FrameError('a continuation frame is missing or unexpected', 1002);
        this.piece(final, payload);
        return;
      case Opcode.binary:
        throw new FrameError('a binary message; only text is expected', 1003);
      case Opcode.close:
        this.ended = true;
        if (payload.length === 1) throw new FrameError('a close frame of one byte', 1002);
        this.listener.close(payload.length < 2 ? undefined : payload.readUInt16BE(0), payload.toString('utf8', 2));
        return;
      case Opcode.ping:
        this.listener.ping(payload);
        return;
      case Opcode.pong:
        return;
      default:
        throw new FrameError(`unknown opcode ${opcode}`, 1002);
    }
  }

  private piece(final: boolean, payload: Buffer): void {
    if (payload.length > 0 || final) this.fragments.push(payload);
    this.fragments_size += payload.length;
    this.in_message = !final;
    if (!final) return;
    const message = this.fragments.length === 1 ? payload : Buffer.concat(this.fragments, this.fragments_size);
    this.fragments = [];
    this.fragments_size = 0;
    let text: string;
    try {
      text = utf8.decode(message);
    } catch {
      throw new FrameError('a text message is not UTF-8', 1007);
    }
    this.listener.text(text);
  }
}

const utf8 = new TextDecoder('utf-8', { fatal: true, ignoreBOM: true });
