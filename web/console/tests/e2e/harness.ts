// The built console in Chromium, before the real gateway.
import { existsSync } from 'node:fs';
import { mkdir, readFile } from 'node:fs/promises';
import { createServer, type IncomingMessage, request as http_request, type Server } from 'node:http';
import { createRequire } from 'node:module';
import { connect } from 'node:net';
import { extname, normalize, resolve } from 'node:path';

import { type Browser, chromium, type Locator, type Page } from 'playwright-core';

import { Gateway, root } from '../../../client/tests/gateway.js';

export { Gateway, root };

const program = process.env['CHROMIUM'] ?? '/usr/bin/chromium';
const dist = `${root}/web/console/dist`;
/** Where pictures land. */
export const pictures = `${root}/web/console/build/pictures`;

/** What the gateway says of the page: nothing inline, nothing from elsewhere. */
const policy =
  "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; connect-src 'self' ws: wss:; " +
  "font-src 'self'; manifest-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
const types: Record<string, string> = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.svg': 'image/svg+xml' };

/** The built files and, behind them, a gateway: as the gateway serves them that has them inside. `gateway` may be another one later. */
export class Front {
  /** Connections to the gateway are refused while this is set. */
  is_cut = false;
  /** Plain requests still pass while it is cut. */
  lets_requests_pass = false;
  /** Demanded of everybody while it is set, as a proxy before a gateway may. */
  token: string | undefined;
  /** Who asks in vain is told that the gateway is shutting down, while this is set: of a real one that takes but a moment. */
  is_draining = false;

  private constructor(
    private readonly server: Server,
    public gateway: string,
  ) {}

  static async before(gateway: string): Promise<Front> {
    if (!existsSync(`${dist}/index.html`)) throw new Error('the console is not built: npm run build in web/console');
    const server = createServer((asked, answer) => {
      if (/^\/(rois|metrics|readyz|healthz)\b/.test(asked.url ?? '')) front.pass_on(asked, answer);
      else void serve_file(asked.url ?? '/', answer);
    });
    const front = new Front(server, gateway);
    server.on('upgrade', (asked, socket) => {
      socket.on('error', () => undefined);
      const [, token] = (asked.headers['sec-websocket-protocol'] ?? '').split(',').map((one) => one.trim());
      if (front.token !== undefined && token !== `rois.bearer.${Buffer.from(front.token).toString('base64url')}`) return void socket.end('HTTP/1.1 401 Unauthorized\r\nContent-Length: 0\r\n\r\n');
      if (front.is_cut) return void socket.destroy();
      const far = connect(Number(new URL(front.gateway).port), '127.0.0.1');
      const lines = asked.rawHeaders.reduce((all, one, i) => all + one + (i % 2 === 0 ? ': ' : '\r\n'), '');
      far.write(`GET ${asked.url} HTTP/1.1\r\n${lines}\r\n`);
      far.on('error', () => socket.destroy()).on('close', () => socket.destroy());
      socket.on('close', () => far.destroy());
      far.pipe(socket).pipe(far);
      front.tunnels.add(() => socket.destroy());
    });
    server.listen(0, '127.0.0.1');
    await new Promise((listening) => server.once('listening', listening));
    return front;
  }

  private readonly tunnels = new Set<() => void>();

  get url(): string {
    return `http://127.0.0.1:${(this.server.address() as { port: number }).port}`;
  }

  /** Breaks every WebSocket, and lets no new one come about until `mend`. */
  cut(): void {
    this.is_cut = true;
    for (const end of this.tunnels) end();
    this.tunnels.clear();
  }
  mend(): void {
    this.is_cut = false;
  }

  async stop(): Promise<void> {
    this.cut();
    this.server.closeAllConnections();
    await new Promise((closed) => this.server.close(closed));
  }

  private pass_on(asked: IncomingMessage, answer: import('node:http').ServerResponse): void {
    if (this.is_cut && !this.lets_requests_pass) return void asked.socket.destroy();
    if (this.token !== undefined && asked.headers.authorization !== `Bearer ${this.token}`) {
      answer.writeHead(401, { 'Content-Type': 'application/xml', 'WWW-Authenticate': 'Bearer' });
      return void answer.end('<fault xmlns="urn:x-rois:psm:xml:message:1" code="unauthorized"><reason>the token is not known here</reason></fault>');
    }
    const far = http_request(`${this.gateway}${asked.url}`, { method: asked.method ?? 'GET', headers: asked.headers }, (came) => {
      answer.writeHead(came.statusCode ?? 500, came.headers);
      came.pipe(answer);
    });
    far.on('error', () => {
      if (!this.is_draining) return void asked.socket.destroy();
      answer.writeHead(503, { 'Content-Type': 'application/xml' });
      answer.end('<fault xmlns="urn:x-rois:psm:xml:message:1" code="shutting_down"><reason>the gateway is shutting down</reason></fault>');
    });
    asked.pipe(far);
  }
}

async function serve_file(url: string, answer: import('node:http').ServerResponse): Promise<void> {
  const path = normalize(new URL(url, 'http://host').pathname);
  const file = resolve(dist, `.${path === '/' ? '/index.html' : path}`);
  const text = file.startsWith(dist) ? await readFile(file).catch(() => undefined) : undefined;
  answer.writeHead(text === undefined ? 404 : 200, {
    'Content-Type': types[extname(file)] ?? 'application/octet-stream',
    'Content-Security-Policy': policy,
    'X-Content-Type-Options': 'nosniff',
  });
  answer.end(text);
}

export type Look = 'dark' | 'light';

export interface PageOptions {
  width?: number;
  height?: number;
  look?: Look;
  language?: 'en' | 'ja';
  motion?: 'reduce' | 'no-preference';
  touch?: boolean;
  /** Complaints of the page that are expected, since the test provokes them. */
  may_complain?: RegExp;
}

export const sizes = { wide: { width: 1600, height: 900 }, tablet: { width: 1024, height: 768 }, small: { width: 768, height: 1024 }, phone: { width: 390, height: 844 }, laptop: { width: 1280, height: 720 }, low: { width: 1366, height: 700 } } as const;

/** In which each panel is judged, beside the wide, dark and English one of all other tests; not wide is touched by fingers. */
export const looks = [
  ['wide', 'light', 'en'],
  ['tablet', 'dark', 'ja'],
] as const;

/** What a page may complain of while a test breaks the link. */
export const broken_link = /WebSocket|Failed to load resource|ERR_/;

// One browser serves all stages that stand at the same time.
let browser: Promise<Browser> | undefined;
let standing = 0;

async function launched(): Promise<Browser> {
  if (!existsSync(program)) throw new Error(`${program} is not there: install chromium, or say in CHROMIUM where one is`);
  standing += 1;
  return (browser ??= chromium.launch({ executablePath: program, args: ['--disable-dev-shm-usage'] }));
}
async function left(): Promise<void> {
  if (--standing > 0) return;
  await (await browser)?.close();
  browser = undefined;
}

/** One gateway, one front, and the browser. */
export class Stage {
  /** Where a page begins that does not say. */
  path = '/';

  private constructor(
    readonly gateway: Gateway,
    readonly front: Front,
    private readonly browser: Browser,
  ) {}

  /** `flags` are the gateway's. For histories that are always the same: `--sim-speed 0` and steps, or a scenario and a seed. */
  static async set(...flags: string[]): Promise<Stage> {
    const browser = await launched();
    const gateway = await Gateway.start(...flags);
    const front = await Front.before(gateway.url);
    return new Stage(gateway, front, browser);
  }

  async strike(): Promise<void> {
    await left();
    await this.front.stop();
    await this.gateway.stop();
  }

  /** A page that shows the console. What it complains of (an exception, a policy that is violated) fails the test at the end of `act`. */
  async page(act: (page: Page) => Promise<void>, options: PageOptions = {}, path = this.path): Promise<void> {
    const { width = sizes.wide.width, height = sizes.wide.height, look = 'dark', language = 'en', motion = 'reduce', touch = false } = options;
    const context = await this.browser.newContext({
      viewport: { width, height },
      colorScheme: look,
      locale: language,
      reducedMotion: motion,
      hasTouch: touch,
      permissions: ['clipboard-read', 'clipboard-write'],
    });
    const page = await context.newPage();
    page.setDefaultTimeout(15_000);
    const complaints: string[] = [];
    page.on('pageerror', (error) => complaints.push(String(error)));
    page.on('console', (message) => {
      // An engine may have no map, and one that is stopped is not ready.
      if (/\/(rois\/map|readyz)$/.test(message.location().url)) return;
      if (message.type() === 'error' || message.type() === 'warning') complaints.push(message.text());
    });
    try {
      await page.goto(this.front.url + path);
      await act(page);
      const unexpected = complaints.filter((one) => !options.may_complain?.test(one));
      if (unexpected.length > 0) throw new Error(`the page complains: ${unexpected.join('\n')}`);
    } finally {
      this.front.mend();
      await context.close();
    }
  }
}

/** A picture of the page in `pictures`. */
export async function picture(page: Page, name: string): Promise<void> {
  await mkdir(pictures, { recursive: true });
  await page.screenshot({ path: `${pictures}/${name}.png` });
}

/** Whether all of it is seen: neither cut off nor below something else. */
export function is_in_view(one: Locator): Promise<boolean> {
  return one.evaluate((part) => {
    const { left, right, top, bottom } = part.getBoundingClientRect();
    const [x, y] = [(left + right) / 2, (top + bottom) / 2];
    return [[x, top + 2], [x, bottom - 2], [left + 2, y], [right - 2, y]].every(([x, y]) => part.contains(document.elementFromPoint(x!, y!)));
  });
}

const axe = createRequire(import.meta.url).resolve('axe-core/axe.min.js');

/** What axe-core has to say against the page as it is now, one rule a line; empty when all is well. */
export async function violations(page: Page): Promise<string> {
  await page.evaluate(await readFile(axe, 'utf8'));
  const { violations: found } = await page.evaluate(() => (window as unknown as { axe: { run(): Promise<{ violations: { id: string; nodes: { html: string; failureSummary?: string }[] }[] }> } }).axe.run());
  return found.map(({ id, nodes }) => `${id}: ${nodes.map(({ html, failureSummary }) => `${html} ${failureSummary ?? ''}`).join(' | ')}`).join('\n');
}
