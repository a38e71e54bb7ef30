// A page with the client in Debian's Chromium.
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { existsSync } from 'node:fs';
import { normalize } from 'node:path';

import { chromium, type Page } from 'playwright-core';

import { root } from './gateway.js';

const program = process.env['CHROMIUM'] ?? '/usr/bin/chromium';

// An import map loads the package without a bundler.
const html = `<!doctype html><title>rois-client</title><script type="importmap">{"imports": {"rois-client": "/dist/browser.js"}}</script>`;

const folders: Record<string, string> = { '/dist/': `${root}/web/client/dist/`, '/tests/': `${root}/web/client/build/tests/kit/` };

/** Opens a page of this origin; `/dist/browser.js` is routed to the client. */
export async function bring_client(page: Page, origin: string): Promise<void> {
  const of_client = (url: string) => `${root}/web/client${new URL(url).pathname}`;
  await page.route(`${origin}/dist/*`, (route) => route.fulfill({ contentType: 'text/javascript', path: of_client(route.request().url()) }));
  await page.goto(origin);
}

/** Serves the page on a free loopback port, so that its origin is unknown to the gateway. Cleans up afterwards. */
export async function in_chromium(dialogue: (page: Page) => Promise<void>, ...switches: string[]): Promise<void> {
  if (!existsSync(program)) throw new Error(`${program} is missing: install chromium, or set CHROMIUM to its path`);
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
    const page = await browser.newPage({ bypassCSP: true }); // the gateway's own page forbids scripts
    await page.goto(`http://127.0.0.1:${(server.address() as { port: number }).port}/`);
    await dialogue(page);
  } finally {
    await browser.close();
    server.closeAllConnections();
    server.close();
  }
}
