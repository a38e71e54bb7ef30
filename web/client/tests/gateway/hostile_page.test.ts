// Pages of another site in a real browser on the operator's machine cannot reach the engine.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import type { Page } from 'playwright-core';

import { Gateway, root } from '../kit/gateway.js';
import { in_chromium } from '../kit/page.js';

const flags = ['--scenario', `${root}/tests/server/data/empty_hall.xml`];
/** The name of the other site resolves to this machine. */
const rebound = '--host-resolver-rules=MAP evil.example 127.0.0.1';
/** Not every browser asks before a page reaches the local network; the gateway must not depend on that. */
const unguarded = '--disable-features=LocalNetworkAccessChecks,PrivateNetworkAccessSendPreflights,BlockInsecurePrivateNetworkRequests';
const message = 'urn:x-rois:psm:xml:message:1';

/** Tries each way in which a page can reach a server. Returns the results. */
async function attack(page: Page, gateway: string): Promise<Record<string, string>> {
  return page.evaluate(
    async ([server, namespace]) => {
      const connect = `<connect xmlns="${namespace}"/>`;
      const post = async (options: RequestInit) =>
        fetch(`${server}/rois`, { method: 'POST', body: connect, ...options }).then(
          (answer) => `${answer.type} ${answer.status}`,
          (error: unknown) => String(error),
        );
      const websocket = (protocols: string[]) =>
        new Promise<string>((done) => {
          const socket = new WebSocket(`${server.replace('http', 'ws')}/rois`, protocols);
          socket.onopen = () => done('open');
          socket.onerror = () => done('refused');
        });
      const event_stream = () =>
        new Promise<string>((done) => {
          const source = new EventSource(`${server}/rois/notifications`);
          source.onopen = () => done('open');
          source.onerror = () => done('refused');
        });
      const in_frame = (prepare: (frame: HTMLIFrameElement) => void) =>
        new Promise<string>((done) => {
          const frame = document.createElement('iframe');
          frame.name = `frame${document.querySelectorAll('iframe').length}`;
          prepare(frame);
          const form = document.forms.namedItem(frame.name);
          let is_empty = form !== null; // until the form's answer arrives
          frame.onload = () => {
            if (is_empty) form?.submit();
            else done(frame.contentDocument === null ? 'not readable' : 'readable');
            is_empty = false;
          };
          document.body.append(frame);
        });
      const form = (type: string) =>
        in_frame((frame) => {
          const one = document.createElement('form');
          one.name = one.target = frame.name;
          one.method = 'POST';
          one.action = `${server}/rois`;
          one.enctype = type;
          const field = document.createElement('input');
          field.name = connect.slice(0, connect.indexOf('='));
          field.value = connect.slice(connect.indexOf('=') + 1);
          one.append(field);
          document.body.append(one);
        });
      return {
        xml: await post({ headers: { 'Content-Type': 'application/xml' } }),
        simple: await post({ mode: 'no-cors', headers: { 'Content-Type': 'text/plain' } }),
        read: await fetch(`${server}/rois/profile`).then(
          async (answer) => `${answer.status} ${(await answer.text()).includes('HRIEngineProfile')}`,
          (error: unknown) => String(error),
        ),
        websocket: await websocket(['rois.xml.v1']),
        event_stream: await event_stream(),
        text_form: await form('text/plain'),
        multipart_form: await form('multipart/form-data'),
        console_in_frame: await in_frame((frame) => (frame.src = `${server}/`)),
        websocket_of_sandbox: await new Promise<string>((done) => {
          addEventListener('message', ({ data }) => done(String(data)), { once: true });
          const frame = document.createElement('iframe');
          frame.sandbox.add('allow-scripts');
          frame.srcdoc = `<script>const socket = new WebSocket('${server.replace('http', 'ws')}/rois', 'rois.xml.v1');
            socket.onopen = () => parent.postMessage('open', '*'); socket.onerror = () => parent.postMessage('refused', '*');</script>`;
          document.body.append(frame);
        }),
      };
    },
    [gateway, message] as const,
  );
}

/** Counts the operations, open sessions, open WebSockets and refusals. */
async function seen_by(gateway: Gateway): Promise<Record<string, number>> {
  const metrics = await (await fetch(`${gateway.url}/metrics`)).text();
  const number = (name: string) => Number(new RegExp(`^${name} (\\d+)`, 'm').exec(metrics)?.[1]);
  return {
    connected: number('rois_requests_total\\{operation="connect",return_code="OK"\\}'),
    sessions: number('rois_sessions'),
    websockets: number('rois_connections\\{kind="websocket"\\}'),
    refused: number('rois_faults_total\\{code="not_allowed"\\}'),
  };
}

test('a page of another site whose name resolves to this machine reaches nothing', (t) =>
  in_chromium(async (page) => {
    const gateway = await Gateway.start(...flags);
    t.after(() => gateway.stop());
    const origin = `http://evil.example:${gateway.port}`; // after DNS rebinding: the page and the gateway have the same origin
    await page.route(`${origin}/attack`, (route) => route.fulfill({ contentType: 'text/html', body: '<!doctype html><title>mine</title>' }));
    await page.goto(`${origin}/attack`);
    const came = await attack(page, origin);
    assert.deepEqual(
      { xml: came['xml'], simple: came['simple'], read: came['read'], websocket: came['websocket'], event_stream: came['event_stream'] },
      { xml: 'basic 421', simple: 'basic 421', read: '421 false', websocket: 'refused', event_stream: 'refused' },
    );
    assert.equal(came['websocket_of_sandbox'], 'refused');
    const { refused, ...rest } = await seen_by(gateway);
    assert.deepEqual(rest, { connected: 0, sessions: 0, websockets: 0 });
    assert.ok(refused! >= 9, `${refused} of 9`);
  }, rebound, unguarded));

test('a cross-site page reaches nothing', (t) =>
  in_chromium(async (page) => {
    const gateway = await Gateway.start(...flags);
    t.after(() => gateway.stop());
    await page.goto(page.url().replace('127.0.0.1', 'evil.example'));
    for (const url of [gateway.url, gateway.url.replace('127.0.0.1', 'localhost')]) {
      const came = await attack(page, url);
      assert.equal(came['websocket'], 'refused');
      assert.equal(came['websocket_of_sandbox'], 'refused');
      assert.equal(came['event_stream'], 'refused');
      for (const way of ['xml', 'read']) assert.match(came[way]!, /^TypeError: /, way);
    }
    const { refused, ...rest } = await seen_by(gateway);
    assert.deepEqual(rest, { connected: 0, sessions: 0, websockets: 0 });
    assert.ok(refused! >= 12, `${refused} of 12`);
  }, rebound, unguarded));

test('the console works under every name of this machine', (t) =>
  in_chromium(async (page) => {
    const gateway = await Gateway.start(...flags, '--hosts', 'gateway.example');
    t.after(() => gateway.stop());
    for (const host of ['127.0.0.1', 'localhost', 'gateway.example']) {
      await page.goto(`http://${host}:${gateway.port}/plain`);
      const came = await attack(page, `http://${host}:${gateway.port}`);
      assert.equal(came['xml'], 'basic 200', host);
      assert.equal(came['read'], '200 true', host);
      assert.equal(came['websocket'], 'open', host);
      assert.equal(came['websocket_of_sandbox'], 'refused', host);
    }
  }, '--host-resolver-rules=MAP gateway.example 127.0.0.1'));
