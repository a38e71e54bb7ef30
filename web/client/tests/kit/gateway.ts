// The real gateway as a child process.
import { type ChildProcess, spawn } from 'node:child_process';
import { existsSync } from 'node:fs';
import { dirname, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

/** The project's root. */
export const root = root_above(dirname(fileURLToPath(import.meta.url)));

function root_above(folder: string): string {
  return existsSync(resolve(folder, 'CMakePresets.json')) ? folder : root_above(dirname(folder));
}

const program = resolve(process.env['ROIS_BINARY_DIR'] ?? `${root}/build/release`, 'bin/rois-gateway');

export class Gateway {
  private constructor(
    private readonly process: ChildProcess,
    readonly url: string,
  ) {}

  /** Starts on a free loopback port and waits until it listens. */
  static async start(...flags: string[]): Promise<Gateway> {
    const child = spawn(program, ['--listen', '127.0.0.1:0', ...flags], { stdio: ['ignore', 'ignore', 'pipe'] });
    let log = '';
    const url = await new Promise<string>((found, failed) => {
      child.on('error', failed);
      child.on('exit', (code) => failed(new Error(`the gateway ended with ${code}: ${log}`)));
      child.stderr!.setEncoding('utf8').on('data', (text: string) => {
        if (log.length < 10_000) log += text;
        const at = /listening on (\S+)\s/.exec(log);
        if (at) found(at[1]!);
      });
    });
    return new Gateway(child, url);
  }

  get port(): number {
    return Number(new URL(this.url).port);
  }

  /** Stops as an operator does, or with SIGKILL as a crash. */
  async stop(signal: 'SIGTERM' | 'SIGKILL' = 'SIGTERM'): Promise<void> {
    if (this.process.exitCode !== null || this.process.signalCode !== null) return;
    const ended = new Promise((resolve) => this.process.once('exit', resolve));
    this.process.kill(signal);
    await ended;
  }
}
