// The members of logical components (docs/choosing.md), and the ones that act now.
import { computed, signal } from '@preact/signals';
import { all_of, property, type Switched } from 'rois-client';

import type { Environment } from '../base/environment';
import type { OwnRequests } from '../session/own_requests';
import type { MetricsState } from './metrics_state';
import type { ProfileState } from './profile_state';

// The engine hides members from conditions that do not refer to engines.
const with_members = all_of(property('component_ref').like('*.*'), property('engine').like('*'));

export class MembersState {
  /** Members by logical component. */
  readonly all = signal<ReadonlyMap<string, readonly string[]>>(new Map());
  private readonly switched = signal<ReadonlyMap<string, { to: string; at: number }>>(new Map());
  private readonly acting = computed(() => new Map([...this.all.value.keys()].map((ref) => [ref, this.acting_now(ref)])));

  constructor(
    private readonly environment: Environment,
    private readonly requests: OwnRequests,
    private readonly profile: ProfileState,
    private readonly metrics: MetricsState,
    /** The components that this console has bound. */
    private readonly mine: () => ReadonlySet<string>,
  ) {}

  /** Reads the members. Call it after the profile was read. */
  async read(): Promise<void> {
    const found = await this.requests.send((client) => client.search(with_members)).catch(() => []);
    const all = new Map<string, string[]>();
    for (const { code, codebook_ref } of found) {
      if (this.profile.component(code)) continue; // not hidden: it stands for itself
      const logical = this.profile.components.value.find(({ ref, type }) => code.endsWith(`.${ref}`) && type === codebook_ref);
      if (logical) all.set(logical.ref, [...(all.get(logical.ref) ?? []), code]);
    }
    this.all.value = all;
  }

  /** The members of a component; none if it is not logical. */
  of(ref: string): readonly string[] {
    return this.all.value.get(ref) ?? [];
  }

  /** The members that act for a component. */
  acting_for(ref: string): readonly string[] {
    return this.acting.value.get(ref) ?? [];
  }

  /** The logical components for which the unit of this component acts. Components that sense are left out: all units act for them. */
  acts_for(component: string): string[] {
    const unit = component.slice(0, component.lastIndexOf('.') + 1);
    return [...this.acting.value].filter(([ref, acting]) => acting.includes(unit + ref) && !this.profile.lasts(ref)).map(([ref]) => ref);
  }

  on_switched({ component_ref, to }: Switched): void {
    this.switched.value = new Map([...this.switched.value, [component_ref.code, { to, at: this.environment.now() }]]);
    this.metrics.poll.now();
  }

  // The engine's own session binds the members that act. A member that an application has bound by its ref does not act.
  private acting_now(ref: string): readonly string[] {
    const { latest, bound } = this.metrics;
    const last = this.switched.value.get(ref);
    if (last && last.at >= (latest.value?.at ?? 0)) return [last.to];
    return bound.value.has(ref) ? this.of(ref).filter((one) => bound.value.has(one) && !this.mine().has(one)) : [];
  }
}
