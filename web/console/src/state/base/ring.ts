// A list that drops its oldest entries.

/** Limited in number and, with a weight function, in total weight (such as bytes). Entries are numbered from 0. */
export class Ring<T> implements Iterable<T> {
  private entries: T[] = [];
  private begin = 0; // index of the first live entry
  private forgotten = 0;
  private weight = 0;

  constructor(
    private readonly most: number,
    private readonly most_weight = Infinity,
    private readonly weigh: (one: T) => number = () => 0,
  ) {}

  push(one: T): void {
    this.entries.push(one);
    this.weight += this.weigh(one);
    while (this.size > this.most || (this.weight > this.most_weight && this.size > 1)) this.forget();
    if (this.begin > 64 && this.begin * 2 > this.entries.length) {
      this.entries = this.entries.slice(this.begin);
      this.begin = 0;
    }
  }

  private forget(): void {
    this.weight -= this.weigh(this.entries[this.begin]!);
    this.entries[this.begin] = undefined as T; // for the garbage collector
    this.begin += 1;
    this.forgotten += 1;
  }

  get size(): number {
    return this.entries.length - this.begin;
  }
  get bytes(): number {
    return this.weight;
  }
  /** The number of the oldest entry. */
  get first(): number {
    return this.forgotten;
  }
  /** By index: 0 is the oldest, -1 the newest. */
  at(index: number): T | undefined {
    return index < 0 ? (this.size + index < 0 ? undefined : this.entries[this.entries.length + index]) : this.entries[this.begin + index];
  }
  /** By number; undefined if dropped or not yet added. */
  numbered(number: number): T | undefined {
    return number < this.forgotten ? undefined : this.entries[this.begin + number - this.forgotten];
  }
  /** The entry whose number by `number_of` is this one. Such numbers must increase from entry to entry. */
  find(number: number, number_of: (one: T) => number): T | undefined {
    let [low, high] = [0, this.size];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (number_of(this.at(middle)!) < number) low = middle + 1;
      else high = middle;
    }
    const found = this.at(low);
    return found !== undefined && number_of(found) === number ? found : undefined;
  }
  list(): T[] {
    return this.entries.slice(this.begin);
  }
  clear(): void {
    this.forgotten += this.size;
    this.entries = [];
    this.begin = 0;
    this.weight = 0;
  }
  *[Symbol.iterator](): Iterator<T> {
    for (let i = this.begin; i < this.entries.length; ++i) yield this.entries[i]!;
  }
}
