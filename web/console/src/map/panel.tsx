// The Map panel: shows robots and persons and sends robots.
import './map.css';

import { useSignal } from '@preact/signals';
import { useLayoutEffect, useMemo, useRef } from 'preact/hooks';

import { useConsole, useWatch } from '../context';
import { Button, IconButton } from '../ui';
import { Board } from './board';
import { type Sending, TargetCard, ThingCard, useSending } from './cards';
import { key_zoom } from './interaction';
import { Motions } from './motions';
import type { Drawing } from './painting/drawing';
import { short_name } from './painting/ground';
import { age, metres, position } from './formats';
import { session_of } from './session';
import * as texts from './texts';
import { ThingsTable } from './things_table';
import { Toolbar } from './toolbar';
import { type Point, round_step } from './view';

export default function MapPanel() {
  const console = useConsole();
  useWatch(console.robots.poll);
  useWatch(console.entities);
  useWatch(console.status.poll);
  const drawing = useSignal<Drawing | undefined>(undefined);
  const pointer = useSignal<Point | undefined>(undefined);
  const sending = useSending();
  return (
    <div class="map">
      <Toolbar />
      <div class="map-floor">
        <div class="map-board">
          <Board begun={(one) => (drawing.value = one)} pointed={(at) => (pointer.value = at)} send={() => sending.send?.()} />
        </div>
        <div class="map-top">
          <Remarks />
          <Motions />
        </div>
        <Chosen sending={sending} drawing={drawing.value} />
      </div>
      <div class="map-foot">
        <div class="map-zoom">
          <IconButton icon="plus" label={texts.zoom_in()} onClick={() => drawing.value?.act({ kind: 'zoom', factor: key_zoom })} />
          <IconButton icon="minus" label={texts.zoom_out()} onClick={() => drawing.value?.act({ kind: 'zoom', factor: 1 / key_zoom })} />
          <IconButton icon="fit" label={texts.fit()} onClick={() => drawing.value?.act({ kind: 'fit' })} />
        </div>
        {drawing.value && <Scale drawing={drawing.value} />}
        <Frame />
        {pointer.value && <span class="map-pointer">{position(pointer.value)}</span>}
      </div>
      <ThingsTable />
    </div>
  );
}

// Places the card on the side where it does not cover its subject, and keeps it there.
function Chosen({ sending, drawing }: { sending: Sending; drawing: Drawing | undefined }) {
  const console = useConsole();
  const session = session_of(console);
  const { target, chosen } = session.interaction.value;
  const key = target ? `${target.x} ${target.y}` : chosen;
  const at_left = useMemo(() => {
    const at = target ?? session.scene().shown.find((one) => one.key === chosen);
    return at !== undefined && drawing !== undefined && drawing.is_right(at);
  }, [key, drawing]);
  // The focused button may have been removed with its card.
  const cards = useRef<HTMLDivElement>(null);
  const about = target ? 'target' : chosen;
  const before = useRef<string>();
  useLayoutEffect(() => {
    if (before.current !== undefined && document.activeElement === document.body)
      (cards.current?.querySelector<HTMLElement>('[type=submit]:enabled') ?? document.querySelector<HTMLElement>('.map-canvas'))?.focus();
    before.current = about;
  }, [about]);
  if (key === undefined) return null;
  return (
    <div ref={cards} class={at_left ? 'map-cards map-cards-left' : 'map-cards'}>
      {target ? <TargetCard target={target} sending={sending} /> : <ChosenThing chosen={chosen!} />}
    </div>
  );
}

// Updated with every position.
function ChosenThing({ chosen }: { chosen: string }) {
  const console = useConsole();
  const session = session_of(console);
  for (const one of [console.robots.pulse.beat, console.entities.pulse.beat, console.now]) void one.value;
  const thing = session.scene().shown.find((one) => one.key === chosen);
  return thing ? (
    <ThingCard key={chosen} thing={thing} close={() => (session.interaction.value = { ...session.interaction.value, chosen: undefined })} />
  ) : null;
}

const least_bar = 60; // px

function Scale({ drawing }: { drawing: Drawing }) {
  const scale = drawing.scale.value;
  if (scale === 0) return null;
  const length = round_step(least_bar / scale);
  const text = metres(length, length < 100 ? 2 : length < 1000 ? 1 : 0);
  return (
    <span class="map-scale" role="img" aria-label={texts.scale(text)}>
      <span class="map-scale-bar" style={{ width: `${length * scale}px` }} />
      <span>{text}</span>
    </span>
  );
}

// The map's frame, or that of the positions if there is no map.
function Frame() {
  const console = useConsole();
  const session = session_of(console);
  void console.robots.pulse.beat.value;
  const crs = session.map?.crs ?? [...console.robots.all.values()][0]?.crs ?? '';
  if (crs === '') return null;
  return (
    <span class="map-frame" title={`${texts.frame()}: ${crs}`}>
      {texts.frame()}: {short_name(crs)}
    </span>
  );
}

/** Remarks about the whole picture. */
function Remarks() {
  const console = useConsole();
  const session = session_of(console);
  const { link, map, now } = console;
  const view = map.view.value;
  for (const pulse of [console.robots.pulse, console.entities.pulse]) void pulse.beat.value;
  const { lost } = session.scene();
  return (
    <>
      {!link.is_open && link.received_at > 0 && <p class="map-remark map-stale">{texts.not_live(age(now.value - link.received_at))}</p>}
      {view.state === 'unknown' && link.is_open && <p class="map-remark">{texts.loading_map()}</p>}
      {view.state === 'none' && <p class="map-remark">{texts.no_map()}</p>}
      {view.state === 'trouble' && (
        <p class="map-remark">
          {texts.map_trouble(view.reason)}{' '}
          <Button small icon="refresh" onClick={() => void map.load()}>
            {texts.reload()}
          </Button>
        </p>
      )}
      {link.is_open &&
        console.entities.all.size === 0 &&
        !session.observer.state.value.is_wanted &&
        session.observer.components.length > 0 && <p class="map-remark map-soft">{texts.nobody_hint()}</p>}
      {lost.length > 0 && (
        <p class="map-remark" title={[...new Set(lost.map((one) => one.crs))].join(', ')}>
          {texts.unplaced(lost.length)}
        </p>
      )}
    </>
  );
}
