import { useLayoutEffect, useRef } from 'preact/hooks';

import { Fact, StatusBadge } from '../ui';
import type { Description } from './describe';

/** Beside a point of its container, inside the window. Not for screen readers. */
export function Tooltip({ description, x, y }: { description: Description; x: number; y: number }) {
  const element = useRef<HTMLDivElement>(null);
  useLayoutEffect(() => {
    const tip = element.current!;
    const around = tip.parentElement!.getBoundingClientRect();
    const { offsetWidth: width, offsetHeight: height } = tip;
    const [at_x, at_y] = [around.left + x, around.top + y];
    const left = at_x + 14 + width > innerWidth ? at_x - 14 - width : at_x + 14;
    const top = at_y + 16 + height > innerHeight ? at_y - 12 - height : at_y + 16;
    tip.style.left = `${Math.max(4, left)}px`;
    tip.style.top = `${Math.max(4, top)}px`;
  });
  const { kind, title, component, state, facts } = description;
  return (
    <div class="timeline-tip" ref={element} aria-hidden="true">
      <p class="timeline-tip-title">
        {kind !== '' && <span>{kind}</span>} <strong>{title}</strong> {state !== '' && state !== title && <StatusBadge status={state} />}
      </p>
      {component !== '' && <p>{component}</p>}
      <dl>
        {facts.map(([name, value]) => (
          <Fact key={name} name={name}>{value}</Fact>
        ))}
      </dl>
    </div>
  );
}
