import { useMemo } from 'preact/hooks';

import * as texts from '../texts';
import { CopyButton } from './copy';
import { laid_out, pieces_of } from './xml_text';

export interface XmlViewProps {
  text: string;
  label?: string;
  /** Show the document unformatted. */
  raw?: boolean;
  /** The line to mark, from 1: the place of a fault. */
  marked_line?: number | undefined;
}

export function XmlView({ text, label, raw = false, marked_line }: XmlViewProps) {
  const lines = useMemo(() => (raw ? text : laid_out(text)).split('\n'), [text, raw]);
  return (
    <div class={raw ? 'xml xml-raw' : 'xml'}>
      <pre tabIndex={0} role="region" aria-label={label ?? texts.xml()}>
        {lines.map((line, i) => (
          <code key={i} class={i + 1 === marked_line ? 'xml-line xml-marked' : 'xml-line'}>
            {pieces_of(line).map((piece, j) => (
              <span key={j} class={`xml-${piece.kind}`}>
                {piece.text}
              </span>
            ))}
            {'\n'}
          </code>
        ))}
      </pre>
      <CopyButton text={text} class="xml-copy" />
    </div>
  );
}
