// Error boundary: a failed panel does not affect the others.
import { Component, type ComponentChildren } from 'preact';

import { reason_of } from '../state/base/reason_of';
import { Button } from '../ui/button';
import { Icon } from '../ui/icon';
import * as texts from '../ui/texts';

interface State {
  failed: { why: unknown } | undefined;
}

export class Boundary extends Component<{ children: ComponentChildren }, State> {
  override state: State = { failed: undefined };

  static override getDerivedStateFromError(why: unknown): State {
    return { failed: { why } };
  }

  override componentDidCatch(error: unknown): void {
    console.error(error);
  }

  override render() {
    const { failed } = this.state;
    if (!failed) return this.props.children;
    return (
      <div class="state state-error" role="alert">
        <Icon name="warning" size={24} />
        <p class="state-title">{texts.panel_failed()}</p>
        <p class="state-more">
          {texts.panel_failed_hint()} <code>{reason_of(failed.why)}</code>
        </p>
        <Button icon="refresh" onClick={() => this.setState({ failed: undefined })}>
          {texts.retry()}
        </Button>
      </div>
    );
  }
}
