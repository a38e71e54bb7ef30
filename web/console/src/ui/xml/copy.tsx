import { useEffect, useState } from 'preact/hooks';

import { useConsole } from '../../context';
import { Button, type ButtonProps } from '../button';
import * as texts from '../texts';
import { curl_of } from './curl';

export interface CopyProps extends Omit<ButtonProps, 'icon' | 'children'> {
  text: string | (() => string);
  label?: string;
}

export function CopyButton({ text, label, ...rest }: CopyProps) {
  const console = useConsole();
  const [copied, set_copied] = useState(false);
  useEffect(() => (copied ? console.environment.after(1500, () => set_copied(false)) : undefined), [copied]);
  const copy = async () => {
    try {
      await write_to_clipboard(typeof text === 'string' ? text : text());
      set_copied(true);
    } catch {
      console.notices.show('warning', texts.copy_failed());
    }
  };
  return (
    <Button small look="quiet" {...rest} icon={copied ? 'check' : 'copy'} onClick={() => void copy()}>
      {copied ? texts.copied() : (label ?? texts.copy())}
    </Button>
  );
}

/** Copies a request as a curl line. It contains the session id: anyone with it can act as this console. */
export function CurlButton({ request, ...rest }: Omit<CopyProps, 'text' | 'label'> & { request: string }) {
  const console = useConsole();
  const line = () =>
    curl_of(request, { origin: console.environment.origin, session: console.link.session.value, token: console.current_token });
  return <CopyButton {...rest} text={line} label={texts.copy_as_curl()} />;
}

// The clipboard API exists only on pages from https or localhost.
async function write_to_clipboard(text: string): Promise<void> {
  if (navigator.clipboard) return navigator.clipboard.writeText(text);
  const area = document.createElement('textarea');
  area.value = text;
  area.className = 'unseen';
  document.body.append(area);
  area.select();
  const done = document.execCommand('copy');
  area.remove();
  if (!done) throw new Error('not copied');
}
