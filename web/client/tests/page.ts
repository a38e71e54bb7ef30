// A page that has the client, in Debian's Chromium.
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { existsSync } from 'node:fs';
import { normalize } from 'node:path';

import { chromium, type Page } from 'playwright-core';

import { root } from './gateway.js';

const program = process.env['CHROMIUM'] ?? '/usr/bin/chromium';

// The package as a browser takes it without a bundler: an import map says where it is.
const html = `<!doctype html><title>rois-client</title><script type="importmap">{"imports": {"rois-client": "/dist/browser.js"}}</script>`;

const folders: Record<string, string> = { '/dist/': `${root}/web/client/dist/`, '/tests/': `${root}/web/client/build/tests/` };

/** Goes to this origin's own page, where the client is `/dist/browser.js` as if its server had it. */
export async function bring_client(page: Page, origin: string): Promise<void> {
  const of_client = (url: string) => `${root}/web/client${new URL(url).pathname}`;
  await page.route(`${origin}/dist/*`, (route) => route.fulfill({ contentType: 'text/javascript', path: of_client(route.request().url()) }));
  await page.goto(origin);
}

/** Serves the page on a free port of the loopback, so its origin is none that a gateway knows by itself; everything ends afterwards. */
export async function in_chromium(dialogue: (page: Page) => Promise<void>, ...switches: string[]): Promise<void> {
  if (!existsSync(program)) throw new Error(`${program} is not there: install chromium, or say in CHROMIUM where one is`);
  const server = createServer(async (request, response) => {
    const path = normalize(request.url ?? '/');
    const folder = Object.keys(folders).find((one) => path.startsWith(one));
    if (folder === undefined) {
      response.setHeader('Content-Type', 'text/html').end(html);
      return;
    }
    const text = await readFile(folders[folder]! + path.slice(folder.length)).catch(() => undefined);
    response.writeHead(text === undefined ? 404 : 200, { 'Content-Type': 'text/javascript' }).end(text);
  }).listen(0, '127.0.0.1');
  await new Promise((resolve) => server.once('listening', resolve));
  const browser = await chromium.launch({ executablePath: program, args: ['--disable-dev-shm-usage', ...switches] });
  try {
    const page = await browser.newPage({ bypassCSP: true }); // the gateway's own page has no scripts, and so allows none
    await page.goto(`http://127.0.0.1:${(server.address() as { port: number }).port}/`);
    await dialogue(page);
  } finally {
    await browser.close();
    server.closeAllConnections();
    server.close();
  }
}
