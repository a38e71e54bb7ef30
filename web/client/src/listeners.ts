// Who wants to be told of what.

/** For each kind of news by its name, those who listen. */
export class Listeners<News> {
  private readonly all = new Map<keyof News, Set<(news: never) => void>>();

  /** Gives the function that ends the listening. */
  add<Kind extends keyof News>(kind: Kind, listener: (news: News[Kind]) => void): () => void {
    const those = this.all.get(kind) ?? new Set();
    this.all.set(kind, those);
    those.add(listener);
    return () => those.delete(listener);
  }

  /** What a listener throws is reported as any error that nobody catches, and hinders nobody else. */
  tell<Kind extends keyof News>(kind: Kind, news: News[Kind]): void {
    for (const listener of this.all.get(kind) ?? []) {
      try {
        (listener as (news: News[Kind]) => void)(news);
      } catch (error) {
        queueMicrotask(() => {
          throw error;
        });
      }
    }
  }
}
