// The built console in Chromium with the real gateway.
import { existsSync } from 'node:fs';
import { mkdir, readFile } from 'node:fs/promises';
import { createServer, type IncomingMessage, request as http_request, type Server } from 'node:http';
import { createRequire } from 'node:module';
import { connect } from 'node:net';
import { extname, normalize, resolve } from 'node:path';

import { type Browser, chromium, type Locator, type Page } from 'playwright-core';

import { Gateway, root } from '../../../client/tests/kit/gateway.js';

export { Gateway, root };

const program = process.env['CHROMIUM'] ?? '/usr/bin/chromium';
const dist = `${root}/web/console/dist`;
/** Folder of the pictures. */
export const pictures = `${root}/web/console/build/pictures`;

/** The gateway's content security policy: nothing inline, nothing external. */
const policy =
  "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; connect-src 'self' ws: wss:; " +
  "font-src 'self'; manifest-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
const types: Record<string, string> = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.svg': 'image/svg+xml' };

/** Serves the built files and forwards to a gateway, as a gateway with the console inside. `gateway` may be changed later. */
export class Front {
  /** Refuse connections to the gateway. */
  is_cut = false;
  /** Let plain requests pass while it is cut. */
  lets_requests_pass = false;
  /** If set, required from every client, as by a proxy before a gateway. */
  token: string | undefined;
  /** Answer that the gateway is shutting down: a real one does so only for a moment. */
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

  /** Breaks every WebSocket and refuses new ones until `restore`. */
  cut(): void {
    this.is_cut = true;
    for (const end of this.tunnels) end();
    this.tunnels.clear();
  }
  restore(): void {
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
  /** Expected errors of the page. */
  may_complain?: RegExp;
}

export const sizes = { wide: { width: 1600, height: 900 }, tablet: { width: 1024, height: 768 }, small: { width: 768, height: 1024 }, phone: { width: 390, height: 844 }, laptop: { width: 1280, height: 720 }, low: { width: 1366, height: 700 } } as const;

/** The looks tested for each panel, in addition to the wide, dark, English one of the other tests. Other sizes use touch. */
export const looks = [
  ['wide', 'light', 'en'],
  ['tablet', 'dark', 'ja'],
] as const;

/** Errors of a page while a test breaks the link. */
export const broken_link = /WebSocket|Failed to load resource|ERR_/;

// One browser serves all stages that exist at the same time.
let browser: Promise<Browser> | undefined;
let standing = 0;

async function launched(): Promise<Browser> {
  if (!existsSync(program)) throw new Error(`${program} is missing: install chromium, or set CHROMIUM to its path`);
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
  /** Default path of a page. */
  path = '/';

  private constructor(
    readonly gateway: Gateway,
    readonly front: Front,
    private readonly browser: Browser,
  ) {}

  /** `flags` are the gateway's. For reproducible histories: `--sim-speed 0` and steps, or a scenario and a seed. */
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

  /** Opens a page with the console. Its errors (exceptions, policy violations) fail the test at the end of `act`. */
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
      this.front.restore();
      await context.close();
    }
  }
}

/** Saves a picture of the page to `pictures`. */
export async function picture(page: Page, name: string): Promise<void> {
  await mkdir(pictures, { recursive: true });
  await page.screenshot({ path: `${pictures}/${name}.png` });
}

/** Whether an element is completely visible. */
export function is_in_view(one: Locator): Promise<boolean> {
  return one.evaluate((part) => {
    const { left, right, top, bottom } = part.getBoundingClientRect();
    const [x, y] = [(left + right) / 2, (top + bottom) / 2];
    return [[x, top + 2], [x, bottom - 2], [left + 2, y], [right - 2, y]].every(([x, y]) => part.contains(document.elementFromPoint(x!, y!)));
  });
}

const axe = createRequire(import.meta.url).resolve('axe-core/axe.min.js');

/** The violations that axe-core finds, one rule on each line; empty if none. */
export async function violations(page: Page): Promise<string> {
  await page.evaluate(await readFile(axe, 'utf8'));
  const { violations: found } = await page.evaluate(() => (window as unknown as { axe: { run(): Promise<{ violations: { id: string; nodes: { html: string; failureSummary?: string }[] }[] }> } }).axe.run());
  return found.map(({ id, nodes }) => `${id}: ${nodes.map(({ html, failureSummary }) => `${html} ${failureSummary ?? ''}`).join(' | ')}`).join('\n');
}
