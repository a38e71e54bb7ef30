// Names for the codes of known codebooks. Engines send only codes.

// Example codebook Reaction_Type of annex D, codes from 1.
const reactions = (
  'nod the head|angle the head|shake the head|look right|look left|look up|look down|drop the head|bow the head|shake hands|' +
  'spread hands slightly|raise hands and spread|spread hands|clap hands|clap hands rhythmically|' +
  'point by the right hand|point by the left hand|' +
  'indicate a monitor display|raise both hands|raise both hands from side|raise both hands at the shoulder height|' +
  'raise a hand straight up (1, waving)|raise a hand straight up (2)|raise the right hand|raise the left hand|turn the right palm down|' +
  'turn the left palm up|wave the hand|move the fingertip up|cross arms (an X)|make a circle with arms|put both hands on the head|' +
  'put a hand on forehead|salute|put a hand to ear|put a hand to mouth|make a V sign|strike the chest lightly|rub the stomach|' +
  'put a hand on the waist|put both hands on the waist (1)|put both hands on the waist (2, head up)|cross arms (in front of chest)|' +
  'swing arms back and forth|knock|push by both hands|indicate a height by a hand|bend an arm|' +
  'put an arm on a shoulder|glance at a wristwatch'
).split('|');

/** The name of a code; undefined if the code or its codebook is unknown. */
export function name_in(codebook: string | undefined, code: string): string | undefined {
  return /::reaction(_type)?$/i.test(codebook ?? '') ? reactions[Number(code) - 1] : undefined;
}

/** `9 – bow the head`; only the code if it has no name. */
export function with_name(codebook: string | undefined, code: string): string {
  const name = name_in(codebook, code);
  return name === undefined ? code : `${code} – ${name}`;
}
