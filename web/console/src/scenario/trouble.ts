// A problem of a scenario or a run. `say` uses the page's language at the time of display.

export type Say = () => string;

export class Trouble extends Error {
  override readonly name = 'Trouble';
  constructor(readonly say: Say) {
    super('the scenario cannot continue');
  }
  static raise(say: Say): never {
    throw new Trouble(say);
  }
}
