// A proxy between client and gateway that simulates network faults.
import { connect, createServer, type Server, type Socket } from 'node:net';

/** Random numbers from 0 to 1 from a seed (mulberry32). */
export function random_from(seed: number): () => number {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

interface Pair {
  near: Socket; // to the client
  far: Socket; // to the gateway
  half_open: boolean; // forwards no more
}

export class Proxy {
  /** Accepted connections. */
  made = 0;
  /** Cut connections. */
  cuts = 0;
  /** Bytes to forward in one turn of the event loop. */
  drip = Infinity;
  /** Delay of each chunk in ms. */
  lateness = 0;
  /** Refuse new connections. */
  refuses = false;
  /** Returns the bytes, in both directions, until the next cut. Called after each cut. */
  next_cut: (() => number) | undefined;

  private readonly pairs = new Set<Pair>();
  private until_cut = Infinity;

  private constructor(
    private readonly server: Server,
    /** The gateway's port; a change applies to new connections. */
    public target: number,
  ) {
    server.on('connection', (near) => this.accept(near));
  }

  static async before(target: number): Promise<Proxy> {
    const server = createServer().listen(0, '127.0.0.1');
    await new Promise((resolve) => server.once('listening', resolve));
    return new Proxy(server, target);
  }

  get port(): number {
    return (this.server.address() as { port: number }).port;
  }
  get url(): string {
    return `http://127.0.0.1:${this.port}`;
  }

  /** Cuts `times` times after random numbers of bytes. */
  cut_at_random(times: number, mean_bytes: number, random: () => number): void {
    const last = this.cuts + times;
    this.next_cut = () => (this.cuts < last ? Math.ceil(random() * 2 * mean_bytes) : Infinity);
    this.cut_after_next();
  }

  /** Cuts all connections. */
  cut(): void {
    for (const { near, far } of this.pairs) {
      near.destroy();
      far.destroy();
    }
    this.cuts += 1;
  }

  /** Applies `next_cut` from now on. */
  cut_after_next(): void {
    this.until_cut = this.next_cut?.() ?? Infinity;
  }

  /** Keeps the present connections open but forwards nothing: the peer is gone without a sign. */
  half_open(): void {
    for (const pair of this.pairs) {
      pair.half_open = true;
      pair.far.destroy();
    }
  }

  async stop(): Promise<void> {
    for (const { near, far } of this.pairs) {
      near.destroy();
      far.destroy();
    }
    await new Promise((resolve) => this.server.close(resolve));
  }

  private accept(near: Socket): void {
    if (this.refuses) {
      near.destroy();
      return;
    }
    this.made += 1;
    const far = connect(this.target, '127.0.0.1');
    const pair = { near, far, half_open: false };
    this.pairs.add(pair);
    near.setNoDelay(true);
    far.setNoDelay(true);
    near.on('error', () => undefined);
    far.on('error', () => undefined);
    near.on('data', (bytes) => this.forward(pair, near, far, bytes));
    far.on('data', (bytes) => this.forward(pair, far, near, bytes));
    near.on('close', () => {
      this.pairs.delete(pair);
      far.destroy();
    });
    far.on('close', () => {
      if (!pair.half_open) near.destroy();
    });
  }

  private forward(pair: Pair, from: Socket, to: Socket, bytes: Buffer): void {
    if (pair.half_open || to.destroyed) return;
    if (bytes.length > this.until_cut) {
      to.write(bytes.subarray(0, this.until_cut), () => this.cut_by_count());
      this.until_cut = 0;
      from.pause();
      return;
    }
    const now = bytes.subarray(0, this.drip);
    const rest = bytes.subarray(now.length);
    this.until_cut -= now.length;
    const going = () => {
      if (to.destroyed || to.write(now)) return;
      from.pause();
      to.once('drain', () => from.resume());
    };
    if (this.lateness > 0) setTimeout(going, this.lateness);
    else going();
    if (rest.length === 0) return;
    from.pause();
    setImmediate(() => {
      from.resume();
      this.forward(pair, from, to, rest);
    });
  }

  private cut_by_count(): void {
    if (this.until_cut !== 0) return;
    this.cut();
    this.cut_after_next();
  }
}
