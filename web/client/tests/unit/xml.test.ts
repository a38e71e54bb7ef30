import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { test } from 'node:test';

import { element, escape_attribute, escape_text, is_notification, notification_of, parse_xml, text_element, XmlError } from 'rois-client';

import { root } from '../kit/gateway.js';

const rois = 'http://www.omg.org/spec/RoIS/20240801';

test('a document is parsed with its namespaces', () => {
  const document = parse_xml(
    `<?xml version="1.0" encoding="UTF-8"?><!-- a --><a xmlns="urn:a" xmlns:r="${rois}" plain='1' r:own="2"><r:b/><c xmlns="">x<d/>y</c></a><!-- b -->\n`,
  );
  assert.equal(document.name, 'a');
  assert.equal(document.namespace, 'urn:a');
  assert.equal(document.attribute('plain'), '1');
  assert.equal(document.attribute('own'), undefined);
  assert.equal(document.attribute('own', rois), '2');
  assert.equal(document.child('b')!.namespace, rois);
  assert.equal(document.child('c')!.namespace, '');
  assert.equal(document.child('c')!.text, 'xy');
  assert.equal(document.child('d'), undefined);
  assert.equal(document.text_of('nobody'), '');
});

test('an inner namespace declaration applies only inside', () => {
  const document = parse_xml('<p:a xmlns:p="urn:1"><p:b xmlns:p="urn:2"><p:c/></p:b><p:b/></p:a>');
  assert.deepEqual(
    document.all('b').map((one) => one.namespace),
    ['urn:2', 'urn:1'],
  );
  assert.equal(document.child('b')!.child('c')!.namespace, 'urn:2');
});

test('texts are parsed as XML requires', () => {
  assert.equal(parse_xml('<a>&lt;&amp;&gt;&quot;&apos;&#65;&#x1F600;</a>').text, `<&>"'A\u{1F600}`);
  assert.equal(parse_xml('<a>1<![CDATA[<&]]>2<!-- no -->3</a>').text, '1<&23');
  assert.equal(parse_xml('<a>1\r\n2\r3&#13;</a>').text, '1\n2\n3\r');
  assert.equal(parse_xml('<a b="1\t2\n3&#9;&#10;"/>').attribute('b'), '1 2 3\t\n');
  assert.equal(parse_xml('\uFEFF<a/>').name, 'a');
  assert.equal(parse_xml('<名前 xmlns="urn:a">お茶</名前>').text, 'お茶');
  assert.equal(parse_xml('<a>]]&gt;</a>').text, ']]>');
});

const broken: [string, string][] = [
  ['', 'nothing'],
  ['text', 'no element'],
  ['<a>', 'an element that is not closed'],
  ['<a></b>', 'a wrong end tag'],
  ['<a/><b/>', 'two roots'],
  ['<a/>x', 'text after the root'],
  ['<a b=1/>', 'no quotes'],
  ['<a b="1" b="2"/>', 'a duplicate attribute'],
  ['<a xmlns:p="urn:1" xmlns:q="urn:1" p:b="1" q:b="2"/>', 'a duplicate attribute by namespace'],
  ['<a b="1"c="2"/>', 'no space between attributes'],
  ['<a b="<"/>', '< in a value'],
  ['<a b="1/>', 'a value that is not closed'],
  ['<p:a/>', 'an undeclared prefix'],
  ['<a p:b="1"/>', 'an attribute with an undeclared prefix'],
  ['<a xmlns:p=""/>', 'a prefix declared as empty'],
  ['<a xmlns:xmlns="urn:a"/>', 'xmlns declared'],
  ['<a:b:c xmlns:a="urn:a"/>', 'two colons'],
  ['<:a/>', 'an empty prefix'],
  ['<a xmlns:p="urn:a"><p:1/></a>', 'a name that begins with a digit'],
  ['<a>&nbsp;</a>', 'an unknown entity'],
  ['<a>&amp</a>', 'a reference without semicolon'],
  ['<a>&#0;</a>', 'a reference to no character'],
  ['<a>&#xD800;</a>', 'a reference to a surrogate'],
  ['<a>&#1114112;</a>', 'a reference beyond Unicode'],
  ['<a>\u0001</a>', 'a control character'],
  ['<a>\uD800</a>', 'a lone surrogate'],
  ['<a>]]></a>', "']]>' in text"],
  ['<a><![CDATA[x</a>', 'a CDATA section that is not closed'],
  ['<a><!-- -- --></a>', 'two hyphens in a comment'],
  ['<a><!-- </a>', 'a comment that is not closed'],
  ['<!DOCTYPE a><a/>', 'a document type'],
  ['<a><!ENTITY b "c"></a>', 'an entity declaration'],
  ['<?php x?><a/>', 'a processing instruction'],
  ['<a><?php x?></a>', 'a processing instruction inside'],
  [' <?xml version="1.0"?><a/>', 'a declaration that is not first'],
  ['<?xml version="1.0" encoding="ISO-8859-1"?><a/>', 'another encoding'],
  ['<a/', 'a tag that is not closed'],
  ['< a/>', 'a space before the name'],
  ['<a>'.repeat(257) + '</a>'.repeat(257), 'too deep nesting'],
];
for (const [text, what] of broken)
  test(`rejected: ${what}`, () => {
    assert.throws(() => parse_xml(text), XmlError);
  });

test('an error gives its place', () => {
  assert.throws(() => parse_xml('<a><b></c></a>'), { message: 'expected </b>, not </c> at offset 8', offset: 8 });
});

test('written XML is parsed back', () => {
  const strange = `<a> & "b" 'c' ]]> \t\n\r お茶 \u{1F600}`;
  const text = element('x', { one: strange, two: undefined, three: 3, four: false }, text_element('y', strange));
  const document = parse_xml(text);
  assert.equal(document.attribute('one'), strange);
  assert.equal(document.attribute('two'), undefined);
  assert.equal(document.attribute('three'), '3');
  assert.equal(document.attribute('four'), 'false');
  assert.equal(document.text_of('y'), strange);
});

test('characters that XML does not allow are rejected in writing', () => {
  for (const text of ['\u0000', '\u001F', '\uFFFE', '\uDC00', '\uD800x']) {
    assert.throws(() => escape_text(text), XmlError);
    assert.throws(() => escape_attribute(text), XmlError);
  }
});

// The engine's documents as sent: in one line or many.
test('every valid sample of the schemas is parsed', () => {
  const folder = `${root}/schemas/samples/valid`;
  const names = readdirSync(folder);
  assert.ok(names.length > 100);
  let notifications = 0;
  for (const name of names) {
    const document = parse_xml(readFileSync(`${folder}/${name}`, 'utf8'));
    if (!is_notification(document)) continue;
    notifications += 1;
    const notification = notification_of(document);
    assert.equal(notification.name, document.name);
    assert.equal(notification.sequence, Number(document.attribute('sequence')));
    if (notification.name === 'receive_event') assert.equal(notification.expire.toISOString(), '2026-11-20T12:01:00.123Z');
  }
  assert.ok(notifications > 10);
});

test('a truncated or altered sample is parsed or rejected with XmlError', () => {
  const text = readFileSync(`${root}/schemas/samples/valid/receive_event_with_results.xml`, 'utf8');
  for (let end = 0; end < text.trimEnd().length; ++end) assert.throws(() => parse_xml(text.slice(0, end)), XmlError);
  for (let at = 0; at < text.length; ++at)
    for (const other of ['<', '>', '&', '"', '/', ' ', ':', '\u0000']) {
      try {
        parse_xml(text.slice(0, at) + other + text.slice(at + 1));
      } catch (error) {
        assert.ok(error instanceof XmlError, String(error));
      }
    }
});
