// A panel that fails takes no other with it.
import { Component, type ComponentChildren } from 'preact';

import { reason_of } from '../state/reason_of';
import { Button } from '../ui/button';
import { Icon } from '../ui/icon';
import * as texts from '../ui/texts';

interface State {
  error?: unknown;
}

export class Boundary extends Component<{ children: ComponentChildren }, State> {
  override state: State = {};

  static override getDerivedStateFromError(error: unknown): State {
    return { error };
  }

  override componentDidCatch(error: unknown): void {
    console.error(error);
  }

  override render() {
    if (!('error' in this.state)) return this.props.children;
    const { error } = this.state;
    return (
      <div class="state state-error" role="alert">
        <Icon name="warning" size={24} />
        <p class="state-title">{texts.panel_failed()}</p>
        <p class="state-more">
          {texts.panel_failed_hint()} <code>{reason_of(error)}</code>
        </p>
        <Button icon="refresh" onClick={() => this.setState({ error: undefined } as State, () => delete this.state.error)}>
          {texts.retry()}
        </Button>
      </div>
    );
  }
}
