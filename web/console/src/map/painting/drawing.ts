// Draws the floor on a canvas: only after changes and at most once a frame.
import { effect, signal, untracked } from '@preact/signals';

import type { Stop } from '../../state/base/environment';
import type { Console } from '../../state/console';
import { bearing, distance, type FloorPose, obstacle_at } from '../../state/floor/floor';
import { goals_of } from '../goals';
import { type Hit, type Input, stepped, type Surroundings } from '../interaction';
import type { Shown } from '../scene';
import type { MapSession } from '../session';
import { box_around, fitted, margin_of, type Point, type Size, to_floor, to_screen, type View, with_point } from '../view';
import { Glide } from './glide';
import { radius_of } from './glyphs';
import { draw_ground, frames_of } from './ground';
import { Labels } from './labels';
import type { Palette } from './palette';
import { type Context, Pen } from './pen';
import { draw_picture, knob_distance, label_of, type Picture, type Preview } from './picture';
import { Trails } from './trails';

/** The needed part of HTMLCanvasElement. */
export interface Sheet {
  width: number;
  height: number;
  getContext(kind: '2d'): Context | null;
}

export interface DrawingTools {
  make_sheet: () => Sheet;
  read_palette: () => Palette;
  /** Reads a signal, so that drawings follow the theme. */
  theme: () => string;
  age_text: (ms: number) => string;
  distance_text: (mm: number) => string;
}

const target_edge = 60; // px, distance of the target from the edge after a resize
const usual_radius = 250; // mm, of a robot that is not on the map
const least_move = 1.5; // px, smallest movement of a resting thing that is drawn
const noise = 4; // standard deviations of a resting robot's position that are not drawn
const reach = { fine: 10, coarse: 20 }; // px, hit radius around a thing

export class Drawing {
  /** Drawings so far, for measurements. */
  readonly counts = { pictures: 0, grounds: 0, trails: 0 };
  /** Pixels per mm in the last frame. */
  readonly scale = signal(0);
  is_coarse = false; // for touch
  private size: Size = { width: 0, height: 0 };
  private ratio = 1; // device pixels per CSS pixel
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

  /** Redraws on changes from now on. */
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
    this.draw(); // resizing clears a canvas
  }

  // Keeps the target visible when its card shrinks the canvas.
  private keep_target(): void {
    const { view, target } = this.session.interaction.peek();
    if (view && target)
      this.session.interaction.value = { ...this.session.interaction.peek(), view: with_point(view, this.size, target, target_edge) };
  }

  /** If true (reduced motion), draws new positions at once, without animation. */
  set is_still(is_still: boolean) {
    this.glide.is_still = is_still;
  }

  // --- User input ---

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

  /** Whether it is in the right half of the screen. */
  is_right(at: Point): boolean {
    return to_screen(this.view, this.size, at).x > this.size.width / 2;
  }

  /** Things near the keyboard's cursor, nearest first. */
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

  /** Whether a new frame would differ: a thing was added, removed or moved, or its label changed. */
  private has_news(): boolean {
    const now = this.console.environment.now();
    const { shown } = this.session.scene();
    const { age_text } = this.tools;
    const is_same = (one: Shown, before: Shown | undefined) =>
      one.key === before?.key &&
      one.freshness === before.freshness &&
      `${one.acts_for}` === `${before.acts_for}` &&
      label_of(one, age_text) === label_of(before, age_text);
    return (
      shown.length !== this.shown.length ||
      shown.some((one, i) => !is_same(one, this.shown[i]) || this.glide.is_news(one.key, received_pose(one), now, this.slack_of(one)))
    );
  }

  // Robot positions are polled and so have noise. Persons are reported only when they move.
  private slack_of({ kind, ellipse }: Shown): number {
    return Math.max(least_move / this.scale.peek(), kind === 'robot' && ellipse ? noise * ellipse.a : 0);
  }

  private request(): void {
    if (this.is_due || this.is_over) return;
    this.is_due = true;
    this.console.environment.before_frame(() => {
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
    return this.glide.pose(one.key, received_pose(one), this.console.environment.now(), this.slack_of(one));
  }

  private pen(context: Context, view: View): Pen {
    return new Pen(context, view, this.size, this.palette!);
  }
}

function received_pose({ x, y, th }: Shown): FloorPose {
  return th === undefined ? { x, y } : { x, y, th };
}

function same(a: readonly unknown[], b: readonly unknown[]): boolean {
  return a.length === b.length && a.every((one, i) => one === b[i]);
}

