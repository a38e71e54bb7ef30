// The components that this console has bound, and binding on demand.
import { signal } from '@preact/signals';
import { type Client, code_of, namespaces, parse_xml, type Switching } from 'rois-client';

import type { LoggedDocument } from './document_log';

/** The owner of a component: this console, another session by its number, or none. */
export type Holder = { who: 'me' } | { who: 'other'; session: string } | { who: 'nobody' };

/** Returns borrowed components and releases the ones that were bound only for the borrower. */
export type GiveBack = () => Promise<void>;

export class Bindings {
  readonly mine = signal<ReadonlySet<string>>(new Set());
  private readonly borrowed = new Map<string, number>(); // bound only for borrowers, with their number
  private readonly kept = new Set<string>();
  // Released components, and the owners known at that time: the metrics may still name this console as the owner.
  private readonly left = new Map<string, unknown>();

  constructor(
    private readonly client: () => Client,
    private readonly others: () => ReadonlyMap<string, string>,
  ) {}

  holder_of(ref: string): Holder {
    if (this.mine.value.has(ref)) return { who: 'me' };
    const session = this.others().get(ref);
    return session === undefined || this.left.get(ref) === this.others() ? { who: 'nobody' } : { who: 'other', session };
  }

  /** The number of borrowers; 0 if the user has bound it. */
  lent(ref: string): number {
    return this.kept.has(ref) ? 0 : (this.borrowed.get(ref) ?? 0);
  }

  /** Binds it until `release`. */
  async bind(ref: string): Promise<void> {
    if (!this.mine.value.has(ref)) await this.client().bind(ref);
    this.kept.add(ref);
  }

  /** Releases it. The engine stops this session's commands on it (decision 6). */
  async release(ref: string): Promise<void> {
    this.kept.delete(ref);
    this.borrowed.delete(ref);
    await this.client().release(ref);
  }

  async release_all(): Promise<void> {
    await Promise.all([...this.mine.value].map((ref) => this.release(ref)));
  }

  /** Binds all or none. Components that were not bound before are released when the last borrower returns them. */
  async borrow(refs: readonly string[], switching?: Switching): Promise<GiveBack> {
    const taken: string[] = [];
    try {
      for (const ref of new Set(refs)) {
        await this.take(ref, switching);
        taken.push(ref);
      }
    } catch (error) {
      await this.give_back(taken);
      throw error;
    }
    let has = true;
    return async () => {
      if (has) await this.give_back(taken);
      has = false;
    };
  }

  /** Binds a component of this type; may choose one that this console has already bound. */
  async borrow_any(type: string, switching?: Switching): Promise<{ ref: string; give_back: GiveBack }> {
    const before = this.mine.value;
    const ref = code_of(await this.client().bind_any(type, { switching }));
    if (!before.has(ref)) this.borrowed.set(ref, 0); // bound only for borrowers
    return { ref, give_back: await this.borrow([ref]) };
  }

  // Binds a component that is bound already only to change its `switching`.
  private async take(ref: string, switching: Switching | undefined): Promise<void> {
    const count = this.borrowed.get(ref);
    const is_mine = this.mine.value.has(ref);
    const counts = count !== undefined || !is_mine;
    if (counts) this.borrowed.set(ref, (count ?? 0) + 1);
    if (is_mine && switching === undefined) return;
    await this.client()
      .bind(ref, { switching })
      .catch((error: unknown) => {
        if (counts) this.lower(ref);
        throw error;
      });
  }

  private lower(ref: string): number {
    const left = (this.borrowed.get(ref) ?? 0) - 1;
    if (left > 0) this.borrowed.set(ref, left);
    else this.borrowed.delete(ref);
    return left;
  }

  private async give_back(refs: string[]): Promise<void> {
    for (const ref of refs) {
      if (!this.borrowed.has(ref) || this.lower(ref) > 0 || this.kept.has(ref) || !this.mine.value.has(ref)) continue;
      this.gone(ref); // before the answer arrives, so that the next borrower binds it again
      await this.client()
        .release(ref)
        .catch(() => undefined); // the session is lost, and the binding with it
    }
  }

  /** Updates from an answer, whether the user or the console sent the request. */
  on_answer({ name, return_code, text, request }: LoggedDocument): void {
    if (return_code !== 'OK' || request === undefined) return;
    if (name === 'bind_response' && request.component !== undefined) this.add(request.component);
    if (name === 'bind_any_response') {
      const ref = parse_xml(text).child('component_ref')?.attribute('code', namespaces.rois);
      if (ref !== undefined) this.add(ref);
    }
    if (name === 'release_response' && request.component !== undefined) this.gone(request.component);
  }

  private gone(ref: string): void {
    this.left.set(ref, this.others());
    if (this.mine.value.has(ref)) this.mine.value = new Set([...this.mine.value].filter((one) => one !== ref));
  }

  /** The session is lost, and its bindings with it. */
  forget(): void {
    this.mine.value = new Set();
    this.borrowed.clear();
    this.kept.clear();
  }

  private add(ref: string): void {
    this.mine.value = new Set([...this.mine.value, ref]);
  }
}
