// Asks for the gateway's token, which is kept for this visit only.
import { useSignal } from '@preact/signals';

import { useConsole } from '../context';
import { Button } from '../ui/button';
import { Dialog } from '../ui/dialog';
import { TextField } from '../ui/field';
import { Form } from '../ui/form';
import * as texts from './texts';

export function TokenDialog() {
  const console = useConsole();
  const token = useSignal('');
  const { phase, reason } = console.link.view.value;
  const connect = () => {
    if (token.value.trim() !== '') console.connect(token.value.trim());
  };
  return (
    <Dialog
      title={texts.token_title()}
      open={phase === 'token'}
      close={() => undefined}
      closable={false}
      actions={
        <Button look="primary" onClick={connect} disabled={token.value.trim() === ''}>
          {texts.connect()}
        </Button>
      }
    >
      <Form submit={connect}>
        <TextField
          label={texts.token_label()}
          hint={texts.token_hint()}
          error={console.current_token === undefined ? reason : `${texts.token_wrong()} ${reason}`}
          value={token.value}
          change={(value) => (token.value = value)}
          input={{ type: 'password', autofocus: true }}
        />
      </Form>
    </Dialog>
  );
}
