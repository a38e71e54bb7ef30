// The state diagram (figure 1). Highlights the current state and the last transition.
import { useSignal } from '@preact/signals';
import { useEffect, useLayoutEffect, useRef } from 'preact/hooks';

import { Button, joined, watch_size } from '../ui';
import type { Desk, Run } from './desk';
import { label_of, label_of_edge } from './graph';
import { type Box, type DrawnEdge, path_of } from './layout';
import type { Scenario, State } from './model';
import { arrow_head, neighbour, picture_of, shown_name } from './picture';
import * as texts from './texts';

const smallest = 0.5; // below this scale it scrolls

export function Diagram({ desk, scenario, edit }: { desk: Desk; scenario: Scenario; edit: (state: string) => void }) {
  const frame = useRef<HTMLDivElement>(null);
  const size = useSignal({ width: 600, height: 600 });
  const is_whole = desk.shows_whole;
  const layout = picture_of(scenario);
  void desk.pulse.beat.value;
  const { run } = desk;
  const current = run?.state ?? '';

  useLayoutEffect(() => {
    const element = frame.current!;
    return watch_size(element, () => (size.value = { width: element.clientWidth, height: element.clientHeight }));
  }, []);
  const fit = Math.min(1, (size.value.width - 2) / layout.width);
  const scale = is_whole.value ? Math.min(fit, (size.value.height - 4) / layout.height) : Math.max(smallest, fit);
  useEffect(() => {
    const box = desk.is_running.value ? layout.boxes.get(current) : undefined;
    if (box) bring_into_view(frame.current!, box, scale);
  }, [current, scale]);

  const chosen = layout.boxes.has(desk.chosen.value) ? desk.chosen.value : '';
  const reachable = chosen || scenario.start;
  const pressed = (event: KeyboardEvent) => {
    const name = (event.target as Element).getAttribute('data-state') ?? '';
    if (event.key === 'Enter' || event.key === ' ') edit(name);
    else {
      const next = neighbour(layout.boxes, name, event.key);
      if (next === undefined) return;
      desk.chosen.value = next;
      frame.current!.querySelector<SVGElement>(`[data-state="${next}"]`)?.focus();
    }
    event.preventDefault();
  };
  return (
    <div class="scenario-diagram">
      <div class="scenario-diagram-frame" ref={frame}>
        <svg
          class="scenario-picture"
          width={layout.width * scale}
          height={layout.height * scale}
          viewBox={`0 0 ${layout.width} ${layout.height}`}
          role="group"
          aria-label={`${texts.diagram()}. ${texts.diagram_hint()}`}
          onKeyDown={pressed}
        >
          {layout.edges.map((one) => (
            <EdgePicture key={`${one.edge.from} ${one.edge.to}`} drawn={one} run={run} choose={() => edit(one.edge.from)} />
          ))}
          {[...scenario.states.values()].map((state) => (
            <StatePicture
              key={state.name}
              state={state}
              box={layout.boxes.get(state.name)!}
              run={run}
              is_start={state.name === scenario.start}
              is_chosen={state.name === chosen}
              is_reachable={state.name === reachable}
              choose={() => edit(state.name)}
            />
          ))}
        </svg>
      </div>
      <Button class="scenario-fit" small aria-pressed={is_whole.value} onClick={() => (is_whole.value = !is_whole.value)}>
        {is_whole.value ? texts.natural() : texts.whole()}
      </Button>
    </div>
  );
}

// Scrolls to the box and its successors.
function bring_into_view(frame: HTMLElement, box: Box, scale: number): void {
  const [top, bottom] = [(box.y - 60) * scale, (box.y + 110) * scale];
  const [left, right] = [(box.x - box.width / 2 - 20) * scale, (box.x + box.width / 2 + 20) * scale];
  const { scrollTop, scrollLeft, clientHeight, clientWidth } = frame;
  const y = top < scrollTop ? top : bottom > scrollTop + clientHeight ? bottom - clientHeight : scrollTop;
  const x = left < scrollLeft ? left : right > scrollLeft + clientWidth ? right - clientWidth : scrollLeft;
  if (y !== scrollTop || x !== scrollLeft) frame.scrollTo({ top: y, left: x });
}

function EdgePicture({ drawn, run, choose }: { drawn: DrawnEdge; run: Run | undefined; choose: () => void }) {
  const { edge, label } = drawn;
  const is_last = run !== undefined && edge.triggers.some((one) => one.node.path === run.last_trigger);
  const leads_on = run !== undefined && run.ended_at === undefined && run.state === edge.from && !run.is_leaving;
  const path = path_of(drawn.points);
  return (
    <g class={joined('scenario-edge', is_last && 'scenario-edge-last', leads_on && 'scenario-edge-open')} aria-hidden="true">
      <path class="scenario-line" d={path} />
      {is_last && <path key={run.taken} class="scenario-flash" d={path} />}
      <path class="scenario-head" d={arrow_head(drawn)} />
      <g class="scenario-label" onClick={choose}>
        <title>{edge.triggers.map(label_of).join('\n')}</title>
        <rect x={label.x - label.width / 2} y={label.y - label.height / 2} width={label.width} height={label.height} rx={8} />
        <text x={label.x} y={label.y + 4}>{label_of_edge(edge)}</text>
      </g>
    </g>
  );
}

interface StateProps {
  state: State;
  box: Box;
  run: Run | undefined;
  is_start: boolean;
  is_chosen: boolean;
  /** The item with the Tab stop; arrows reach the others. */
  is_reachable: boolean;
  choose: () => void;
}

function StatePicture({ state, box, run, is_start, is_chosen, is_reachable, choose }: StateProps) {
  const { name, is_end, failed } = state;
  const is_current = run?.state === name;
  const is_left = is_current && run.is_leaving;
  const visits = run?.visits.get(name) ?? 0;
  const [x, y] = [box.x - box.width / 2, box.y - box.height / 2];
  const marks = [
    is_start && texts.starts_here(),
    is_end && (failed ? texts.is_failed() : texts.is_end()),
    is_left ? texts.is_left() : is_current && texts.is_current(),
    visits > 0 && texts.visits(visits),
  ].filter(Boolean);
  const leads = state.triggers.map((one) => texts.leads_to(shown_name(one.to), label_of(one))).join(', ');
  const classes = joined(
    'scenario-state',
    is_end && 'scenario-end',
    failed && 'scenario-failed',
    is_current && 'scenario-current',
    is_current && run.ended_at === undefined && 'scenario-live',
    is_left && 'scenario-left',
    is_chosen && 'scenario-chosen',
  );
  return (
    <g
      class={classes}
      role="button"
      tabindex={is_reachable ? 0 : -1}
      data-state={name}
      aria-label={texts.state_name(shown_name(name), [...marks, leads].join('. '))}
      aria-pressed={is_chosen}
      aria-current={is_current ? 'step' : undefined}
      onClick={choose}
    >
      {visits > 0 && <title>{texts.visits(visits)}</title>}
      <rect class="scenario-ring" x={x - 4} y={y - 4} width={box.width + 8} height={box.height + 8} rx={10} />
      <rect class="scenario-box" x={x} y={y} width={box.width} height={box.height} rx={is_end ? 16 : 7} />
      {is_end && <rect class="scenario-inner" x={x + 3} y={y + 3} width={box.width - 6} height={box.height - 6} rx={13} />}
      {is_start && <circle class="scenario-dot" cx={x} cy={box.y} r={5} />}
      {is_current && <path class="scenario-sign" d={`M${x + 9} ${box.y - 5}v10l8 -5z`} />}
      <text x={box.x} y={box.y + 4.5}>{shown_name(name)}</text>
      {visits > 1 && <text class="scenario-count" x={x + box.width - 7} y={box.y + 4}>{`×${visits}`}</text>}
    </g>
  );
}
