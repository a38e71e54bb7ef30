// What the state needs of the world around it. A browser gives it, or a test.
import type { OpenSocket } from 'rois-client';

/** Ends something. */
export type Stop = () => void;

export interface Environment {
  /** Of the gateway: `http://127.0.0.1:8080`. */
  readonly origin: string;
  /** ms since 1970. */
  now(): number;
  /** ms, with fractions, of a clock that nobody sets: for how long something takes. */
  precise(): number;
  every(ms: number, act: () => void): Stop;
  after(ms: number, act: () => void): Stop;
  /** Once, before the next picture is drawn. */
  before_picture(act: () => void): void;
  fetch(path: string, init?: RequestInit): Promise<Response>;
  readonly open_socket: OpenSocket;
  /** What is remembered from one visit to the next; strings by name. */
  recall(name: string): string | undefined;
  remember(name: string, value: string): void;
}
