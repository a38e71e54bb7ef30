// A panel in its place: fetched when it is first shown, with a boundary around it.
import type { ComponentType } from 'preact';
import { useEffect, useState } from 'preact/hooks';

import type { Panel } from '../panels';
import { ErrorState, Loading } from '../ui/states';
import { Boundary } from './boundary';

const loaded = new Map<string, ComponentType>();

export function PanelFrame({ panel }: { panel: Panel }) {
  const [, again] = useState(0);
  const [trouble, set_trouble] = useState<unknown>();
  const Content = loaded.get(panel.id);
  const fetch_it = () => {
    set_trouble(undefined);
    panel.load().then(
      ({ default: content }) => {
        loaded.set(panel.id, content);
        again((n) => n + 1);
      },
      (error: unknown) => set_trouble(error),
    );
  };
  useEffect(() => {
    if (!Content) fetch_it();
  }, [panel]);
  return (
    <div class={`panel panel-${panel.id}`}>
      {trouble !== undefined ? <ErrorState error={trouble} retry={fetch_it} /> : Content ? <Boundary key={panel.id}><Content /></Boundary> : <Loading />}
    </div>
  );
}
