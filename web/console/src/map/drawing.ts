// Draws the floor on a canvas: nothing while nothing changes, and never more than once a picture.
import { effect, signal, untracked } from '@preact/signals';

import type { Console } from '../state/console';
import type { Stop } from '../state/environment';
import { bearing, distance, type FloorPose, obstacle_at } from '../state/floor';
import { radius_of } from './glyphs';
import { Glide } from './glide';
import { goals_of } from './goals';
import { draw_ground, frames_of } from './ground';
import { type Hit, type Input, stepped, type Surroundings } from './interaction';
import { Labels } from './labels';
import type { Palette } from './palette';
import { type Context, Pen } from './pen';
import { draw_picture, knob_distance, label_of, type Picture, type Preview } from './picture';
import type { Shown } from './scene';
import type { MapSession } from './session';
import { Trails } from './trails';
import { box_around, fitted, margin_of, type Point, type Size, to_floor, to_screen, type View, with_point } from './view';

/** As much of a canvas as this needs. */
export interface Sheet {
  width: number;
  height: number;
  getContext(kind: '2d'): Context | null;
}

export interface DrawingTools {
  make_sheet: () => Sheet;
  read_palette: () => Palette;
  /** A signal is read in it: called again when that changes. */
  theme: () => string;
  age_text: (ms: number) => string;
  distance_text: (mm: number) => string;
}

const target_edge = 60; // px that the target keeps from the edge when the size changes
const usual_radius = 250; // mm, of a robot that is not on the map
const least_move = 1.5; // px that a thing at rest moves before it is drawn elsewhere
const noise = 4; // standard deviations that a robot at rest may seem to move
const reach = { fine: 10, coarse: 20 }; // px around a thing that still hit it

export class Drawing {
  /** What was drawn so far, for those who measure. */
  readonly counts = { pictures: 0, grounds: 0, trails: 0 };
  /** Pixels a mm, of the last picture. */
  readonly scale = signal(0);
  is_coarse = false; // fingers point
  private size: Size = { width: 0, height: 0 };
  private ratio = 1; // pixels of the device for one of CSS
  private is_due = false;
  private is_over = false;
  private shown: Shown[] = [];
  private palette: Palette | undefined;
  private ground_of: unknown[] = [];
  private trails_of: unknown[] = [];
  private readonly ground: Sheet;
  private readonly ways: Sheet;
  private readonly glide = new Glide();
  private readonly trails = new Trails();
  private readonly labels = new Labels();

  constructor(
    private readonly console: Console,
    private readonly session: MapSession,
    private readonly sheet: Sheet,
    private readonly tools: DrawingTools,
  ) {
    this.ground = tools.make_sheet();
    this.ways = tools.make_sheet();
  }

  /** Draws from now on whatever changes. */
  start(): Stop {
    const { robots, entities, commands, map, link, status, bindings } = this.console;
    const { interaction, hovered, layers, engine } = this.session;
    const stop = effect(() => {
      for (const one of [commands.pulse.beat, map.view, link.view, bindings.mine, interaction, hovered, layers, engine]) void one.value;
      untracked(() => this.request());
    });
    const stop_things = effect(() => {
      for (const one of [robots.pulse.beat, entities.pulse.beat, status.all, this.console.now]) void one.value;
      untracked(() => this.has_news() && this.request());
    });
    const stop_theme = effect(() => {
      this.tools.theme();
      this.palette = undefined;
      untracked(() => this.request());
    });
    return () => {
      this.is_over = true;
      for (const one of [stop, stop_things, stop_theme]) one();
    };
  }

  /** In CSS pixels. */
  resize(size: Size, ratio: number): void {
    this.size = size;
    this.ratio = ratio;
    for (const sheet of [this.sheet, this.ground, this.ways]) {
      sheet.width = Math.round(size.width * ratio);
      sheet.height = Math.round(size.height * ratio);
    }
    this.keep_target();
    this.draw(); // a canvas that gets another size is empty
  }

  // The card of the target may have made the picture smaller.
  private keep_target(): void {
    const { view, target } = this.session.interaction.peek();
    if (view && target) this.session.interaction.value = { ...this.session.interaction.peek(), view: with_point(view, this.size, target, target_edge) };
  }

  /** With reduced motion things jump. */
  set is_still(is_still: boolean) {
    this.glide.is_still = is_still;
  }

  // --- What the user does ---

  act(input: Input): void {
    const before = this.session.interaction.peek();
    const after = untracked(() => stepped(before, input, this.surroundings()));
    if (after !== before) this.session.interaction.value = after;
  }

  get view(): View {
    return this.session.interaction.value.view ?? this.whole();
  }

  floor_at(at: Point): Point {
    return to_floor(this.view, this.size, at);
  }

  /** Whether it is drawn in the right half. */
  is_right(at: Point): boolean {
    return to_screen(this.view, this.size, at).x > this.size.width / 2;
  }

  /** What is near the keyboard's cursor, the nearest first. */
  near(point: Point): Shown[] {
    return this.shown.filter((one) => distance(one, point) < 2000).sort((a, b) => distance(a, point) - distance(b, point));
  }

  hit(at: Point): Hit {
    const view = this.view;
    const reached = (point: Point, radius: number) => distance(at, to_screen(view, this.size, point)) <= radius;
    const around = this.is_coarse ? reach.coarse : reach.fine;
    const { target } = this.session.interaction.value;
    if (target) {
      const th = target.th ?? this.arrival(target);
      const size = this.driven_radius() * view.scale;
      const away = knob_distance(size, to_screen(view, this.size, target), th, this.size) / view.scale;
      const knob = { x: target.x + away * Math.cos((th * Math.PI) / 180), y: target.y + away * Math.sin((th * Math.PI) / 180) };
      if (reached(knob, 7 + around) || reached(target, Math.max(12, size))) return { what: 'target' };
    }
    const pen = { length: (mm: number) => mm * view.scale };
    const thing = this.shown
      .filter((one) => one.kind !== 'face' && reached(this.pose_of(one), radius_of(pen, one) + around / 2))
      .sort((a, b) => distance(at, to_screen(view, this.size, a)) - distance(at, to_screen(view, this.size, b)))[0];
    if (thing) return { what: 'thing', key: thing.key };
    const place = this.session.layers.value.places && this.session.map?.places.find((one) => reached(one, around));
    return place ? { what: 'place', name: place.name, x: place.x, y: place.y, th: place.heading } : { what: 'floor' };
  }

  private surroundings(): Surroundings {
    return {
      size: this.size,
      whole: this.whole(),
      hit: (at) => this.hit(at),
      arrival: (at) => this.arrival(at),
      things: this.shown.filter((one) => one.kind !== 'face'),
    };
  }

  private whole(): View {
    return fitted(this.session.map?.bounds ?? box_around(this.shown), this.size, margin_of(this.size));
  }

  private arrival(at: Point): number {
    const robot = this.driven();
    return robot ? bearing(robot, at) : 0;
  }

  private driven(): Shown | undefined {
    const ref = this.session.driver()?.robot?.ref;
    return ref === undefined ? undefined : this.shown.find((one) => one.key === `robot ${ref}`);
  }

  private driven_radius(): number {
    return this.driven()?.radius ?? usual_radius;
  }

  // --- Drawing ---

  /** Whether a picture drawn now would differ from the last one: something has come, gone or moved, or its label has changed. */
  private has_news(): boolean {
    const now = this.console.environment.now();
    const { shown } = this.session.scene();
    const { age_text } = this.tools;
    const is_same = (one: Shown, before: Shown | undefined) => one.key === before?.key && one.freshness === before.freshness && label_of(one, age_text) === label_of(before, age_text);
    return shown.length !== this.shown.length || shown.some((one, i) => !is_same(one, this.shown[i]) || this.glide.is_news(one.key, told(one), now, this.slack_of(one)));
  }

  // People are told of only when they move; a robot's position is asked for, so it comes with noise.
  private slack_of({ kind, ellipse }: Shown): number {
    return Math.max(least_move / this.scale.peek(), kind === 'robot' && ellipse ? noise * ellipse.a : 0);
  }

  private request(): void {
    if (this.is_due || this.is_over) return;
    this.is_due = true;
    this.console.environment.before_picture(() => {
      this.is_due = false;
      if (!this.is_over) this.draw();
    });
  }

  private draw(): void {
    const context = this.sheet.getContext('2d');
    if (!context || this.size.width < 1 || this.size.height < 1) return;
    const { interaction, layers, hovered } = this.session;
    const now = this.console.environment.now();
    this.palette ??= this.tools.read_palette();
    this.shown = untracked(() => this.session.scene().shown);
    this.glide.keep(new Set(this.shown.map((one) => one.key)));
    const view = untracked(() => this.view);
    this.counts.pictures += 1;
    this.scale.value = view.scale;
    this.draw_ground(view);
    if (layers.peek().trails) this.draw_trails(view, now);
    const pen = this.pen(context, view);
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.drawImage(this.ground as unknown as CanvasImageSource, 0, 0);
    context.globalAlpha = 0.5;
    if (layers.peek().trails) context.drawImage(this.ways as unknown as CanvasImageSource, 0, 0);
    context.globalAlpha = 1;
    context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    const pose = (one: Shown) => this.pose_of(one);
    if (layers.peek().trails) this.draw_trail_ends(pen, pose);
    const { chosen, cursor } = interaction.peek();
    const picture = untracked((): Picture => ({
      shown: this.shown,
      pose,
      goals: goals_of(this.console, this.shown),
      places: this.session.map?.places ?? [],
      frames: this.session.map ? frames_of(this.session.map) : [],
      layers: layers.value,
      chosen,
      hovered: hovered.value,
      cursor,
      preview: this.preview(),
      age_text: this.tools.age_text,
    }));
    draw_picture(pen, picture, this.labels);
    if (this.glide.is_moving(now)) this.request();
  }

  private draw_ground(view: View): void {
    const map = this.console.map.view.peek();
    const layers = this.session.layers.peek();
    const of = [view.x, view.y, view.scale, this.size, this.ratio, map, layers, this.palette];
    if (same(of, this.ground_of)) return;
    this.ground_of = of;
    this.counts.grounds += 1;
    const context = this.ground.getContext('2d')!;
    context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    draw_ground(this.pen(context, view), map.state === 'there' ? map.map : undefined, layers);
  }

  private draw_trails(view: View, now: number): void {
    const of = [view.x, view.y, view.scale, this.size, this.ratio, this.palette];
    const context = this.ways.getContext('2d')!;
    if (!same(of, this.trails_of) || this.trails.is_stale(this.shown)) {
      this.trails_of = of;
      this.counts.trails += 1;
      this.trails.forget();
      context.setTransform(1, 0, 0, 1, 0, 0);
      context.clearRect(0, 0, this.ways.width, this.ways.height);
    }
    context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    this.trails.draw(this.pen(context, view), this.shown, now);
  }

  private draw_trail_ends(pen: Pen, pose: (one: Shown) => FloorPose): void {
    for (const one of this.shown) {
      const end = this.trails.end_of(one.key);
      if (!end) continue;
      pen.line(pen.at(end), pen.at(pose(one)));
      pen.stroke(pen.palette[one.kind], one.kind === 'robot' ? 2.5 : 1.8, 0.5);
    }
  }

  private preview(): Preview | undefined {
    const { target } = this.session.interaction.value;
    if (!target) return undefined;
    const robot = this.driven();
    const radius = this.driven_radius();
    const from = robot && this.pose_of(robot);
    const is_blocked = target.place === undefined && obstacle_at(this.session.map, target, radius) !== undefined;
    return { target, radius, from, text: from ? this.tools.distance_text(distance(from, target)) : '', is_blocked };
  }

  private pose_of(one: Shown): FloorPose {
    return this.glide.pose(one.key, told(one), this.console.environment.now(), this.slack_of(one));
  }

  private pen(context: Context, view: View): Pen {
    return new Pen(context, view, this.size, this.palette!);
  }
}

function told({ x, y, th }: Shown): FloorPose {
  return th === undefined ? { x, y } : { x, y, th };
}

function same(a: readonly unknown[], b: readonly unknown[]): boolean {
  return a.length === b.length && a.every((one, i) => one === b[i]);
}

