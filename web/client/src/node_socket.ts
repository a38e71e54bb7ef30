// A WebSocket over Node's HTTP module, because Node 18 has none.
import { createHash, randomBytes } from 'node:crypto';
import { type ClientRequest, type IncomingMessage, request as http_request } from 'node:http';
import { request as https_request } from 'node:https';
import type { Duplex } from 'node:stream';
import type { TLSSocket } from 'node:tls';

import { frame, FrameError, FrameReader, Opcode } from './node_frames.js';
import { type OpenSocket, type Socket, type SocketEnd, type SocketListener, subprotocol } from './socket.js';

const most_refusal = 64 * 1024; // bytes read of a refusal's body
const close_within = 2000; // ms for the gateway to close the connection after our close frame

class NodeSocket implements Socket {
  private readonly request: ClientRequest;
  private readonly key = randomBytes(16).toString('base64');
  private stream: Duplex | undefined;
  private listening = true;

  constructor(
    url: string,
    subprotocols: string[],
    private readonly listener: SocketListener,
  ) {
    const target = new URL(url.replace(/^ws/, 'http'));
    this.request = (target.protocol === 'https:' ? https_request : http_request)(target, {
      agent: false,
      headers: {
        Connection: 'Upgrade',
        Upgrade: 'websocket',
        'Sec-WebSocket-Version': '13',
        'Sec-WebSocket-Key': this.key,
        'Sec-WebSocket-Protocol': subprotocols.join(', '),
      },
    });
    this.request.on('upgrade', (answer, stream, head) => this.upgraded(answer, stream, head));
    this.request.on('response', (answer) => this.refused(answer));
    this.request.on('error', (error) => this.failed(error));
    this.request.end();
  }

  send(text: string): void {
    this.stream?.write(frame(Opcode.text, Buffer.from(text)));
  }

  close(): void {
    this.listening = false;
    const stream = this.stream;
    if (stream === undefined) {
      this.request.destroy();
      return;
    }
    stream.end(frame(Opcode.close, Buffer.from([0x03, 0xe8])));
    const timer = setTimeout(() => stream.destroy(), close_within);
    stream.once('close', () => clearTimeout(timer));
  }

  private upgraded(answer: IncomingMessage, stream: Duplex, head: Buffer): void {
    stream.on('error', (error) => this.end({ reason: error.message, final: false }));
    if (!this.listening) {
      stream.destroy();
      return;
    }
    const accept = createHash('sha1').update(`${this.key}258EAFA5-E914-47DA-95CA-C5AB0DC85B11`).digest('base64');
    if (answer.headers['sec-websocket-accept'] !== accept || answer.headers['sec-websocket-protocol'] !== subprotocol) {
      stream.destroy();
      this.end({ reason: `the server does not speak ${subprotocol}`, final: true });
      return;
    }
    this.stream = stream;
    const reader = new FrameReader({
      text: (message) => this.listening && this.listener.received(message),
      // A server that does not read its answers receives no more of them.
      ping: (payload) => stream.writableNeedDrain || stream.write(frame(Opcode.pong, payload)),
      close: (code, reason) => {
        stream.end(frame(Opcode.close, Buffer.alloc(0)));
        const why = `the gateway closed the link with ${code ?? 'no code'}${reason && `, ${reason}`}`;
        this.end(code === undefined ? { reason: why, final: false } : { reason: why, final: false, code });
      },
    });
    const feed = (bytes: Buffer) => {
      try {
        reader.feed(bytes);
      } catch (error) {
        if (!(error instanceof FrameError)) throw error;
        stream.end(frame(Opcode.close, Buffer.from([error.code >> 8, error.code & 255])));
        stream.removeListener('data', feed);
        stream.resume();
        this.end({ reason: `the gateway violates the WebSocket protocol: ${error.message}`, final: false });
      }
    };
    stream.on('close', () => this.end({ reason: 'the link broke', final: false }));
    stream.on('end', () => stream.end());
    this.listener.opened();
    if (head.length > 0) feed(head);
    stream.on('data', feed);
  }

  // The connection failed. A failure of TLS is final.
  private failed(error: NodeJS.ErrnoException): void {
    const socket = this.request.socket as Partial<TLSSocket> | null;
    if (socket?.authorizationError) this.end({ reason: `the gateway's certificate is rejected: ${error.message}`, final: true });
    else if (error.code === 'EPROTO') this.end({ reason: `the TLS handshake failed: ${error.message.trim()}`, final: true });
    else this.end({ reason: error.message, final: false });
  }

  // The server answered without upgrading. Status and body say why.
  private refused(answer: IncomingMessage): void {
    let text = '';
    answer.setEncoding('utf8');
    answer.on('data', (piece: string) => {
      if (text.length < most_refusal) text += piece;
    });
    answer.on('close', () => {
      const status = answer.statusCode ?? 0;
      const later = status === 408 || status === 429 || status >= 500;
      this.end({ reason: `the gateway answered ${status}: ${text.trim()}`, final: !later });
    });
  }

  private end(end: SocketEnd): void {
    if (this.listening) this.listener.ended(end);
    this.listening = false;
  }
}

export const open_node_socket: OpenSocket = (url, subprotocols, listener) => new NodeSocket(url, subprotocols, listener);
