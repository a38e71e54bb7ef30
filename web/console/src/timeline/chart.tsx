// The drawn lanes with pointer and keyboard input.
import { effect, untracked, useComputed, useSignal } from '@preact/signals';
import { useCallback, useEffect, useLayoutEffect, useRef } from 'preact/hooks';

import { useConsole } from '../context';
import { shown_theme } from '../shell/theme';
import { useDrawing, watch_size } from '../ui';
import { describe_whole, phase_text, sentence } from './describe';
import { type Lane, lay_out, type Layout, next_thing, type Placed, thing_at, time_of } from './layout';
import { axis_height, paint } from './paint';
import { Pointing } from './pointing';
import * as texts from './texts';
import { key_of, type Thing } from './things';
import { Tooltip } from './tooltip';
import type { TimeView } from './view';

export interface ChartProps {
  view: TimeView;
  opened: Thing | undefined;
  open: (thing: Thing) => void;
}

const zoom_step = 1.5;
const look_every = 50; // ms, shortest period of redrawing a live chart; once a second at rest
const longest_rest = 10_000; // ms that a resting pointer holds the time

export function Chart({ view, opened, open }: ChartProps) {
  const console = useConsole();
  const frame = useRef<HTMLDivElement>(null);
  const layout = useRef<Layout>();
  const lanes = useSignal<readonly Lane[]>([]);
  const hovered = useSignal<{ thing: Thing; x: number; y: number } | undefined>(undefined);
  const focused = useSignal<Placed | undefined>(undefined);
  const choice = useSignal<{ from: number; to: number } | undefined>(undefined);
  const drawn = useRef(0); // time of the last frame, to detect a step of one pixel
  void shown_theme.value; // reads the colours again

  const place = (width: number): Layout => {
    const { sources } = view;
    return lay_out(sources, view.range(sources.at, sources), {
      width,
      hides_quiet: view.hides_quiet.peek(),
      with_own: view.with_own.peek(),
    });
  };
  const drawing = useDrawing((sheet) => {
    const next = place(sheet.width);
    layout.current = next;
    const at = view.sources.at;
    drawn.current = at;
    if (shape_of(next.lanes) !== shape_of(lanes.peek())) lanes.value = next.lanes;
    // The shown range, for tests.
    Object.assign(sheet.pen.canvas.dataset, { from: String(next.range.from), to: String(next.range.to) });
    const under = hovered.peek();
    paint(sheet, {
      layout: next,
      at,
      scroll: frame.current!.scrollTop,
      hovered: under && key_of(under.thing),
      opened: opened && key_of(opened),
      focused: focused.peek()?.spot,
      choice: choice.peek(),
      phase_text,
    });
  });
  const { canvas, redraw } = drawing;

  const is_at_work = useComputed(() => {
    void console.commands.pulse.beat.value;
    return console.commands.open().length > 0;
  });
  // Redraws after changes, and when live time has moved by a pixel.
  useEffect(
    () =>
      effect(() => {
        for (const one of [view.stretch, view.held, view.hides_quiet, view.with_own, hovered, focused, choice, console.profile.components])
          void one.value;
        if (view.is_live) for (const one of [console.commands.pulse, console.events.pulse, console.history.pulse]) void one.beat.value;
        redraw();
      }),
    [view],
  );
  useEffect(() => {
    const is_calm = matchMedia('(prefers-reduced-motion: reduce)');
    const look = () => {
      if (!view.is_live || console.environment.now() - drawn.current < view.stretch.peek().span / Math.max(1, layout.current?.width ?? 1))
        return;
      redraw();
      if (pointer.current) hover(pointer.current); // other things move under it
    };
    const stop_looking = effect(() => (is_at_work.value && !is_calm.matches ? console.environment.every(look_every, look) : undefined));
    const stop = effect(() => {
      void console.now.value;
      untracked(look);
    });
    return () => {
      stop_looking();
      stop();
    };
  }, [view]);

  const found = (event: { clientX: number; clientY: number }): { placed: Placed | undefined; x: number; y: number } => {
    const box = canvas.current!.getBoundingClientRect();
    const [x, y] = [event.clientX - box.left, event.clientY - box.top];
    return {
      x,
      y,
      placed: y < axis_height || !layout.current ? undefined : thing_at(layout.current, x, y - axis_height + frame.current!.scrollTop),
    };
  };
  const time_at = (x: number) => (layout.current ? time_of(x, layout.current.range, layout.current.width) : 0);
  const pointing = useRef<Pointing>();
  pointing.current ??= new Pointing({
    view,
    width: () => layout.current?.width ?? 1,
    time_at,
    choose: (range) => (choice.value = range),
    click: (event) => {
      const { placed } = found(event);
      if (!placed) return;
      open(placed.thing);
      pointer.current = undefined;
      hovered.value = undefined; // its tooltip would cover the details
    },
  });
  const pointer = useRef<{ clientX: number; clientY: number }>();
  // Live time is held while the pointer moves over the chart, until it leaves or rests.
  const resting = useRef(0);
  const release = () => {
    clearTimeout(resting.current);
    view.held.value = undefined;
  };
  const hold = () => {
    if (!view.is_live) return;
    view.held.value ??= layout.current?.range.to;
    clearTimeout(resting.current);
    resting.current = window.setTimeout(release, longest_rest);
  };
  useEffect(() => release, []);
  const hover = (event: { clientX: number; clientY: number } | undefined) => {
    if (event && pointer.current?.clientX !== event.clientX) hold();
    pointer.current = event && { clientX: event.clientX, clientY: event.clientY };
    if (!event) {
      release();
      hovered.value = undefined;
      return;
    }
    const { placed, x, y } = found(event);
    const before = hovered.peek();
    if (!placed) hovered.value = undefined;
    else if (!before || key_of(before.thing) !== placed.key || Math.abs(before.x - x) > 2) hovered.value = { thing: placed.thing, x, y };
  };

  const wheel = useCallback((event: WheelEvent) => {
    event.preventDefault();
    const far = event.deltaMode === 1 ? 33 : 1;
    const { width } = layout.current ?? { width: 1 };
    if (event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY))
      view.move((((event.deltaX || event.deltaY) * far) / width) * view.stretch.peek().span);
    else view.zoom(Math.exp((event.deltaY * far) / 400), time_at(found(event).x));
  }, []);
  // Preact's own listeners are passive: the page would scroll.
  useEffect(() => {
    canvas.current!.addEventListener('wheel', wheel, { passive: false });
  }, []);
  // The canvas has the height of the visible part and stays while the lanes scroll.
  useLayoutEffect(() => watch_size(frame.current!, () => (canvas.current!.style.height = `${frame.current!.clientHeight}px`)), []);

  const go = (key: 'ArrowLeft' | 'ArrowRight' | 'ArrowUp' | 'ArrowDown') => {
    view.pause();
    const next = place(canvas.current!.clientWidth);
    const from = focused.peek();
    const placed = next_thing(next, from && next.placed.find((one) => one.spot === from.spot), key);
    focused.value = placed;
    if (placed) bring_into_sight(frame.current!, placed);
  };
  const pressed = (event: KeyboardEvent) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const third = view.stretch.peek().span / 3;
    const acts: Record<string, () => void> = {
      ArrowLeft: () => go('ArrowLeft'), ArrowRight: () => go('ArrowRight'), ArrowUp: () => go('ArrowUp'), ArrowDown: () => go('ArrowDown'),
      Enter: () => focused.peek() && open(focused.peek()!.thing),
      ' ': () => (view.is_live ? view.pause() : view.go_live()),
      '+': () => view.zoom(1 / zoom_step), '=': () => view.zoom(1 / zoom_step), '-': () => view.zoom(zoom_step),
      PageUp: () => view.move(-third), PageDown: () => view.move(third),
      Home: () => view.go_to_oldest(), End: () => view.go_live(),
      Backspace: () => view.undo(),
      Escape: () => {
        pointing.current!.cancel();
        focused.value = undefined;
      },
    };
    const act = acts[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  };

  const chosen = focused.value;
  return (
    <div class="timeline-frame" ref={frame} onScroll={redraw}>
      <div class="timeline-inside" style={{ height: `${lanes.value.reduce((sum, one) => sum + one.height, axis_height)}px` }}>
        <LaneNames lanes={lanes.value} />
        <div
          class="timeline-place"
          role="application"
          tabIndex={0}
          aria-label={texts.label()}
          aria-describedby="timeline-help"
          onKeyDown={pressed}
          onBlur={() => (focused.value = undefined)}
        >
          <canvas
            ref={canvas}
            class="timeline-canvas"
            aria-hidden="true"
            onPointerDown={(event) => pointing.current!.down(event)}
            onPointerMove={(event) => pointing.current!.move(event) || hover(event)}
            onPointerUp={(event) => pointing.current!.up(event)}
            onPointerCancel={() => pointing.current!.cancel()}
            onPointerLeave={() => hover(undefined)}
            onDblClick={() => view.undo()}
          />
          <Tip view={view} layout={layout} frame={frame} hovered={hovered.value} focused={chosen} />
        </div>
      </div>
      <p id="timeline-help" class="unseen">{texts.help()}</p>
      <p class="unseen" role="status">{chosen ? sentence(describe_whole(console, chosen.thing, view.sources.at)) : ''}</p>
    </div>
  );
}

const lane_names = { link: texts.link, commands: texts.commands, events: texts.events };

function LaneNames({ lanes }: { lanes: readonly Lane[] }) {
  const name_of = ({ kind, ref }: Lane) => (kind === 'component' ? ref : lane_names[kind]());
  return (
    <ul class="timeline-names" aria-label={texts.lanes()} style={{ paddingTop: `${axis_height}px` }}>
      {lanes.map((lane) => (
        <li
          key={`${lane.kind} ${lane.ref}`}
          class={`timeline-name timeline-name-${lane.kind}`}
          style={{ height: `${lane.height}px` }}
          title={name_of(lane)}
        >
          <span>{name_of(lane)}</span>
        </li>
      ))}
    </ul>
  );
}

interface TipProps {
  view: TimeView;
  layout: { current: Layout | undefined };
  frame: { current: HTMLDivElement | null };
  hovered: { thing: Thing; x: number; y: number } | undefined;
  focused: Placed | undefined;
}

// Beside the pointer or the focused thing.
function Tip({ view, layout, frame, hovered, focused }: TipProps) {
  const console = useConsole();
  const at = view.sources.at;
  if (hovered) return <Tooltip description={describe_whole(console, hovered.thing, at)} x={hovered.x} y={hovered.y} />;
  const placed = focused && layout.current?.placed.find((one) => one.spot === focused.spot);
  if (!placed) return null;
  const { x, y, width, height } = placed.box;
  return (
    <Tooltip
      description={describe_whole(console, placed.thing, at)}
      x={Math.max(0, x) + Math.min(width, 40) / 2}
      y={y + height + axis_height - (frame.current?.scrollTop ?? 0)}
    />
  );
}

function bring_into_sight(frame: HTMLDivElement, { box }: Placed): void {
  const room = frame.clientHeight - axis_height;
  if (box.y < frame.scrollTop) frame.scrollTop = box.y - 4;
  else if (box.y + box.height > frame.scrollTop + room) frame.scrollTop = box.y + box.height + 4 - room;
}

function shape_of(lanes: readonly Lane[]): string {
  return lanes.map(({ kind, ref, height }) => `${kind} ${ref} ${height}`).join();
}
