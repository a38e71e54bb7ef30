// An application as a child process.
import { spawn } from 'node:child_process';

/** Returns its standard output; rejects with its standard error if it fails. Passes standard error to `logged` as it arrives. */
export function output_of(
  [program, ...args]: string[],
  url: string,
  environment: Record<string, string> = {},
  logged: (text: string) => void = () => undefined,
): Promise<string> {
  return new Promise((resolve, reject) => {
    const env = { ...process.env, ROIS_URL: url, PYTHONDONTWRITEBYTECODE: '1', ...environment };
    const child = spawn(program!, args, { env, stdio: ['ignore', 'pipe', 'pipe'] });
    let [out, log] = ['', ''];
    child.stdout.setEncoding('utf8').on('data', (text: string) => (out += text));
    child.stderr.setEncoding('utf8').on('data', (text: string) => {
      log += text;
      logged(text);
    });
    child.on('error', reject);
    child.on('close', (code) => (code === 0 ? resolve(out) : reject(new Error(`it ended with ${code}: ${log}`))));
  });
}
