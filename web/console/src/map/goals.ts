// Where robots are under way to, whoever has sent them.
import { code_of, component_ref, pose_of, type Parameter, type Results } from 'rois-client';

import type { Console } from '../state/console';
import { Poll } from '../state/poll';
import { distance, on_map } from './floor';
import { type Driver, drivers_of, motions_of } from './driving';
import { position } from './says';
import type { Shown } from './scene';
import type { Point } from './view';

export interface Goal extends Point {
  driver: Driver;
  kind: 'go' | 'follow';
  th?: number;
  text: string; // the name of the place or of whom it follows, or where it is
  /** Sent by this console; of others' one only knows what they have set last. */
  is_mine: boolean;
}

const arrived = 300; // mm
const period = 2000; // ms

/** The parameters of what moves, asked for while others have it bound. */
export class Goals {
  readonly poll: Poll;
  private readonly told = new Map<string, Results>();

  constructor(private readonly console: Console) {
    this.poll = new Poll(console.environment, period, () => this.ask(), () => console.link.is_open);
  }

  of(shown: readonly Shown[]): Goal[] {
    return drivers_of(this.console).flatMap((driver) => this.of_driver(driver, shown) ?? []);
  }

  private of_driver(driver: Driver, shown: readonly Shown[]): Goal | undefined {
    const mine = motions_of(this.console, driver).at(-1);
    const refs = mine ? [mine.component] : [driver.navigation, driver.follow].filter((ref) => ref !== undefined && this.is_with_others(ref));
    for (const ref of refs) {
      const given = (name: string) => parameter(mine?.arguments, name) ?? this.told.get(ref!)?.get(name);
      const goal = ref === driver.follow ? this.followed(given('target_object_ref'), shown) : this.place(given('target_position'));
      if (!goal) continue;
      const is_there = driver.robot !== undefined && distance(driver.robot, goal) < arrived;
      if (mine || !is_there) return { ...goal, driver, is_mine: mine !== undefined };
    }
    return undefined;
  }

  // The last position is where it ends.
  private place(target: Parameter | undefined): Omit<Goal, 'driver' | 'is_mine'> | undefined {
    const text = target?.values.at(-1)?.trim();
    if (text === undefined) return undefined;
    const view = this.console.map.view.value;
    const map = view.state === 'there' ? view.map : undefined;
    const place = map?.places.find((one) => one.name.toLowerCase() === text.toLowerCase());
    if (place) return { kind: 'go', x: place.x, y: place.y, th: place.heading, text: place.name };
    const pose = pose_of(text);
    const placed = pose && on_map(map, target?.data_type_ref.codebook_ref ?? '', text.split(',').length > 2 ? pose : { x: pose.x, y: pose.y });
    return placed && { kind: 'go', ...placed, text: position(placed) };
  }

  private followed(target: Parameter | undefined, shown: readonly Shown[]): Omit<Goal, 'driver' | 'is_mine'> | undefined {
    const ref = target?.values[0];
    const whom = shown.find((one) => (one.kind === 'person' || one.kind === 'robot') && (one.identity?.ref === ref || one.thing.ref === ref));
    return whom && { kind: 'follow', x: whom.x, y: whom.y, text: whom.name };
  }

  private is_with_others(ref: string): boolean {
    return this.console.status.of(ref)?.status === 'BUSY';
  }

  private async ask(): Promise<void> {
    const { console } = this;
    const asked = drivers_of(console)
      .flatMap(({ navigation, follow }) => [navigation, follow])
      .filter((ref) => ref !== undefined)
      .filter((ref) => this.is_with_others(ref) || console.commands.open().some((one) => one.component === ref));
    await Promise.all(
      asked.map(async (ref) => {
        const { component_ref: from, results } = await console.documents.as_own(() => console.query('get_parameter', component_ref(ref)));
        this.told.set(code_of(from), results);
      }),
    );
  }
}

function parameter(all: readonly Parameter[] | undefined, name: string): Parameter | undefined {
  return all?.find((one) => one.name.toLowerCase() === name);
}
