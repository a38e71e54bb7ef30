// Listeners by kind of news.

/** A set of listeners for each kind of news. */
export class Listeners<News> {
  private readonly all = new Map<keyof News, Set<(news: never) => void>>();

  /** Returns a function that removes the listener. */
  add<Kind extends keyof News>(kind: Kind, listener: (news: News[Kind]) => void): () => void {
    const listeners = this.all.get(kind) ?? new Set();
    this.all.set(kind, listeners);
    listeners.add(listener);
    return () => listeners.delete(listener);
  }

  /** Calls the listeners. An exception of one is reported as uncaught and does not keep it from the others. */
  notify<Kind extends keyof News>(kind: Kind, news: News[Kind]): void {
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
