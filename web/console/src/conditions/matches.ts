// Polls `search` for the components that match a condition while watched.
import { signal } from '@preact/signals';
import { Condition, everything } from 'rois-client';

import type { Stop } from '../state/base/environment';
import { Poll } from '../state/base/poll';
import type { Console } from '../state/console';
import { type Draft, leaves_of, type Node } from './model';
import { is_of_results, type Reference } from './vocabulary';
import { condition_of, written } from './writing';

export interface Matches {
  /** Refs of matching components, in the engine's order. */
  refs: readonly string[];
  /** The error of the last search, or undefined. After an error, `refs` are those of an earlier search. */
  trouble: unknown;
  is_old: boolean; // `refs` and `trouble` belong to an earlier condition
}

const debounce = 300; // ms
const period = 2000; // ms: status, bindings and places change without the user

export class LiveMatches {
  readonly found = signal<Matches | undefined>(undefined);
  private readonly poll: Poll;
  private condition: Condition | undefined;
  private may_be: (ref: string) => boolean = () => true;
  private stop_waiting: Stop | undefined;
  private turn = 0;

  constructor(private readonly console: Console) {
    this.poll = new Poll(console.environment, period, () => this.ask(), () => console.link.is_open && this.condition !== undefined);
  }

  watch(): Stop {
    return this.poll.watch();
  }

  /** Searches for this condition after a short delay; undefined: incomplete, search for nothing. */
  look_for(condition: Condition | undefined, may_be: (ref: string) => boolean): void {
    this.may_be = may_be;
    if (condition?.xml === this.condition?.xml) return;
    this.turn += 1;
    this.condition = condition;
    if (this.found.value) this.found.value = { ...this.found.value, is_old: true };
    this.stop_waiting?.();
    this.stop_waiting = this.console.environment.after(debounce, () => void this.ask().catch(() => undefined));
  }

  private async ask(): Promise<void> {
    const { condition, turn } = this;
    if (!condition || !this.console.link.is_open) return;
    try {
      const refs = await this.console.documents.as_own(() => this.console.search(condition));
      if (turn === this.turn)
        this.found.value = { refs: refs.map(({ code }) => code).filter((ref) => this.may_be(ref)), trouble: undefined, is_old: false };
    } catch (trouble) {
      if (turn === this.turn) this.found.value = { refs: this.found.value?.refs ?? [], trouble, is_old: false };
    }
  }
}

/** The part of the condition that can be decided now, without the results of an event or answer. */
export function component_part(draft: Draft, references: readonly Reference[]): Condition {
  if (draft.purpose === 'search' || draft.purpose === 'bind_any') return condition_of(draft, references);
  const known = certain(draft.root, references);
  return (known && written(known, references)) ?? everything;
}

// The part that every match must fulfil; undefined: unknown. A negated node must be decidable as a whole.
function certain(node: Node, references: readonly Reference[]): Node | undefined {
  if (node.kind !== 'group') return is_certain(node, references) ? node : undefined;
  const members = node.members
    .map((one) => (node.is_not ? (is_certain(one, references) ? one : undefined) : certain(one, references)))
    .filter((one): one is Node => one !== undefined);
  const needs_all = (node.joined === 'Or') !== node.is_not;
  if (members.length === 0 || (needs_all && members.length < node.members.length)) return undefined;
  return { ...node, members };
}

function is_certain(node: Node, references: readonly Reference[]): boolean {
  return leaves_of(node).every((one) =>
    one.kind === 'written' ? !/Result\/|located|timestamp/.test(one.xml) : !is_of_results(one.reference, references),
  );
}

/** Whether a part depends on the results of an event or answer. */
export function waits_for_results({ root }: Draft, references: readonly Reference[]): boolean {
  return !is_certain(root, references);
}
