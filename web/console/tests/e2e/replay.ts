// A recording served as an engine by the real command.
import { spawn } from 'node:child_process';
import { resolve } from 'node:path';

import { root } from './harness';

const program = resolve(process.env['ROIS_BINARY_DIR'] ?? `${root}/build/release`, 'bin/rois');

/** Calls `act` with the URL on which `rois replay` serves the file. */
export async function replayed(file: string, act: (url: string) => Promise<void>): Promise<void> {
  const replay = spawn(program, ['replay', file, '--listen', '127.0.0.1:0', '--speed', '0'], { stdio: ['ignore', 'pipe', 'pipe'] });
  const ended = new Promise((resolve) => replay.once('exit', resolve));
  try {
    await act(
      await new Promise<string>((listens, failed) => {
        let said = '';
        const on_output = (text: Buffer) => {
          said += String(text);
          const found = /http:\/\/127\.0\.0\.1:\d+/.exec(said);
          if (found) listens(found[0]);
        };
        replay.stdout.on('data', on_output);
        replay.stderr.on('data', on_output);
        void ended.then(() => failed(new Error(`rois replay ended: ${said}`)));
      }),
    );
  } finally {
    replay.kill();
    await ended;
  }
}
