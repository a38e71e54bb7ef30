// The installed package.
import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { after, before, test } from 'node:test';

import { Gateway, root } from '../kit/gateway.js';
import { output_of } from '../kit/program.js';

const source = `${root}/web/client`;
let outside: string; // a project with the package installed
let files: string[];

before(() => {
  outside = mkdtempSync(`${tmpdir()}/rois-client-`);
  const packed = execFileSync('npm', ['pack', '--json', '--loglevel=error', '--pack-destination', outside], { cwd: source, encoding: 'utf8' });
  const [made] = JSON.parse(packed.slice(packed.indexOf('[')));
  files = made.files.map((one: { path: string }) => one.path).sort();
  mkdirSync(`${outside}/node_modules/rois-client`, { recursive: true });
  execFileSync('tar', ['-xzf', `${outside}/${made.filename}`, '--strip-components=1', '-C', `${outside}/node_modules/rois-client`]);
});
after(() => rmSync(outside, { recursive: true, force: true }));

test('the package holds the needed files and no others', () => {
  const manifest = JSON.parse(readFileSync(`${outside}/node_modules/rois-client/package.json`, 'utf8'));
  assert.equal(manifest.name, 'rois-client');
  for (const kind of ['dependencies', 'optionalDependencies', 'peerDependencies', 'bundleDependencies']) assert.equal(manifest[kind], undefined, kind);
  assert.deepEqual(files.filter((file) => !file.startsWith('dist/')), ['LICENSE', 'README.md', 'package.json']);
  const modules = readdirSync(`${source}/src`).map((file) => file.replace(/\.ts$/, ''));
  assert.deepEqual(files.filter((file) => file.startsWith('dist/')), modules.flatMap((one) => [`dist/${one}.d.ts`, `dist/${one}.js`]).sort());
  for (const file of [manifest.exports['.'].node, manifest.exports['.']].flatMap((one) => [one.types, one.default]))
    assert.ok(existsSync(`${outside}/node_modules/rois-client/${file}`), file);
  assert.equal(readFileSync(`${source}/LICENSE`, 'utf8'), readFileSync(`${root}/LICENSE`, 'utf8'));
});

test('a browser loads no module for Node', () => {
  const reached = new Set<string>();
  const read = (file: string): void => {
    if (reached.has(file)) return;
    reached.add(file);
    for (const [, from] of readFileSync(`${outside}/node_modules/rois-client/dist/${file}`, 'utf8').matchAll(/from '([^']+)'/g)) {
      assert.match(from!, /^\.\//, `${file} imports ${from}`);
      read(from!.slice(2));
    }
  };
  read('browser.js');
  assert.ok(reached.size > 10);
});

// Compiles the README's program for Node and browsers and runs it in Node.
test("an outside project finds the types, and the README's program runs", async () => {
  const [, program] = /```ts\n([^]*?)```/.exec(readFileSync(`${outside}/node_modules/rois-client/README.md`, 'utf8'))!;
  writeFileSync(`${outside}/package.json`, '{"type": "module"}');
  writeFileSync(`${outside}/readme.ts`, program!.replace("'http://127.0.0.1:8080'", "(globalThis as any).process.env.ROIS_URL"));
  writeFileSync(`${outside}/wrong.ts`, "import { connect } from 'rois-client';\nconst n: number = await connect();\nexport { n };\n");
  const compile = (...args: string[]) => {
    const tsc = [`${root}/web/node_modules/typescript/bin/tsc`, '--strict', '--skipDefaultLibCheck', '--target', 'es2022'];
    const { stdout } = spawnSync(process.execPath, [...tsc, ...args], { cwd: outside, encoding: 'utf8' });
    return stdout.trim();
  };
  assert.equal(compile('--module', 'esnext', '--moduleResolution', 'bundler', '--noEmit', 'readme.ts'), '');
  assert.equal(
    compile('--module', 'nodenext', 'readme.ts', 'wrong.ts'),
    "wrong.ts(2,7): error TS2322: Type 'Client' is not assignable to type 'number'.",
  );
  const gateway = await Gateway.start('--scenario', `${root}/tests/server/data/one_visitor.xml`, '--sim-speed', '50');
  try {
    assert.equal(await output_of([process.execPath, `${outside}/readme.js`], gateway.url), '1 person(s)\narrived\n');
  } finally {
    await gateway.stop();
  }
});
