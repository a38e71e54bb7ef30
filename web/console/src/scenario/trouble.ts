// What is wrong with a scenario, or has ended it: said in the language that the page has when it is shown.

export type Say = () => string;

export class Trouble extends Error {
  override readonly name = 'Trouble';
  constructor(readonly say: Say) {
    super('a scenario cannot go on');
  }
  static raise(say: Say): never {
    throw new Trouble(say);
  }
}
