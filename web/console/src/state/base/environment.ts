// The environment that the state needs, provided by the browser or a test.
import type { OpenSocket } from 'rois-client';

/** Ends something. */
export type Stop = () => void;

export interface Environment {
  /** The gateway's: `http://127.0.0.1:8080`. */
  readonly origin: string;
  /** ms since 1970. */
  now(): number;
  /** ms with fractions, from a monotonic clock, for measuring times. */
  precise(): number;
  every(ms: number, act: () => void): Stop;
  after(ms: number, act: () => void): Stop;
  /** Once, before the next frame. */
  before_frame(act: () => void): void;
  fetch(path: string, init?: RequestInit): Promise<Response>;
  readonly open_socket: OpenSocket;
  /** Stored strings by name, kept across visits. */
  recall(name: string): string | undefined;
  remember(name: string, value: string): void;
}
