// Writes parsed elements as XML with the prefixes that requests declare.
import { element, escape_text, namespaces, type XmlElement } from 'rois-client';

const prefixes = new Map<string, string>(
  (['rois', 'fes', 'gml', 'unr', 'xsi'] as const).map((prefix) => [namespaces[prefix], `${prefix}:`]),
);

/** A fragment in an element that declares all prefixes. */
export function wrapped(fragment: string): string {
  const declared = [...prefixes].map(([namespace, prefix]) => ` xmlns:${prefix.slice(0, -1)}="${namespace}"`);
  return `<condition xmlns="${namespaces.message}"${declared.join('')}>${fragment.replace(/^\s*<\?xml[^>]*\?>/, '')}</condition>`;
}

/** Without white space between elements. */
export function text_of_element(one: XmlElement): string {
  const attributes = Object.fromEntries(
    one.attributes.map(({ name, namespace, value }) => [(prefixes.get(namespace) ?? '') + name, value]),
  );
  const text = one.children.length > 0 ? one.text.trim() : one.text;
  return element((prefixes.get(one.namespace) ?? '') + one.name, attributes, escape_text(text), ...one.children.map(text_of_element));
}
