// The reception scenario of the specification (figure 1): wait for a visitor, go there, identify them, give the visitor's message or ask,
// bow, say goodbye, return to the start. Prints one line for each visitor.
//   reception [VISITORS]     visitors to receive before it ends [1]; ROIS_URL: the gateway
import { type Client, connect, Navigation, PersonDetection, PersonIdentification, PersonLocalization, type Pose } from 'rois-client';
import { property, Reaction, SpeechRecognition, SpeechSynthesis, SystemInformation } from 'rois-client';

const messages: Record<string, string> = {
  tanaka: 'Mr. Tanaka, your meeting is in room 3.',
  suzuki: 'Ms. Suzuki, your taxi is waiting at the entrance.',
  somebody: 'Welcome. How can I help you?',
};
const near = (a: Pose | undefined, b: Pose | undefined, mm: number) => a && b && Math.hypot(a.x - b.x, a.y - b.y) <= mm;

async function receive(client: Client, visitors: number): Promise<void> {
  client.on('gap', (gap) => console.error('missed', gap));
  const detection = await PersonDetection.bind_any(client);
  const localization = await PersonLocalization.bind_any(client);
  const identification = await PersonIdentification.bind_any(client);
  const recognition = await SpeechRecognition.bind_any(client);
  const synthesis = await SpeechSynthesis.bind_any(client);
  const reaction = await Reaction.bind_any(client);
  const navigation = await Navigation.bind_any(client);
  const detected = await detection.subscribe('person_detected', property('number').greater_than(0));
  const localized = await localization.subscribe('person_localized');
  const identified = await identification.subscribe('person_identified');
  const recognized = await recognition.subscribe('speech_recognized');
  const start = (await new SystemInformation(client, 'system_information').robot_position())[0]!;
  const met = new Set<string>(); // temporary names and permanent ids of received visitors
  // Looks around once. Returns the persons with their positions.
  async function look(): Promise<Map<string, Pose>> {
    localized.clear();
    await localization.start();
    const results = (await localized.next(3000))?.results;
    await localization.stop();
    const poses = results?.poses('position_data') ?? [];
    return new Map(results?.texts('person_ref').map((person, i) => [person, poses[i]!]));
  }
  // Goes to a point one metre in front of a person, or beside that if there is no way.
  async function go_before({ x, y, th }: Pose): Promise<boolean> {
    for (const side of [0, 60, -60, 120, -120].map((turn) => th + turn)) {
      const [ahead, aside] = [1000 * Math.cos((side * Math.PI) / 180), 1000 * Math.sin((side * Math.PI) / 180)];
      const place = { x: Math.round(x + ahead), y: Math.round(y + aside), th: Math.round(side + 180) };
      if ((await navigation.go_to(place, { time_limit: 90_000 })).ok) return true;
    }
    return false;
  }
  // Goes to the first standing person who was not received. Standing: three looks find the person at one place.
  async function approach(): Promise<string | undefined> {
    const before = await look();
    await new Promise((resolve) => setTimeout(resolve, 1000));
    for (const [person, pose] of await look())
      if (!met.has(person) && near(before.get(person), pose, 300))
        return (await go_before(pose)) && near(pose, (await look()).get(person), 600) ? person : undefined;
    return undefined;
  }
  // Asks a question and returns the visitor's answer.
  async function ask(question: string): Promise<string | undefined> {
    await recognition.listen();
    await synthesis.say(question);
    const answer = (await recognized.next(10_000))?.results.text('recognized_text');
    await recognition.stop();
    recognized.clear();
    if (answer !== undefined) await synthesis.say('I shall tell my colleagues at the desk.');
    return answer;
  }
  for (let received = 0; received < visitors; ) {
    await navigation.go_to(start); // where the robot sees the hall
    await detection.start();
    await detected.next(30_000);
    await detection.stop();
    const person = await approach();
    if (person === undefined) continue;
    await identification.start();
    const visitor = (await identified.next(8000))?.results.text('person_ref') ?? 'somebody';
    await identification.stop();
    identified.clear();
    met.add(person);
    if (met.has(visitor)) continue;
    const message = messages[visitor] ?? 'Welcome. There is no message for you today.';
    const answer = visitor === 'somebody' ? await ask(message) : void (await synthesis.say(message));
    if (visitor !== 'somebody') met.add(visitor);
    await reaction.react(9);
    await synthesis.say('Goodbye.');
    console.log(`${visitor}: told "${message}"${answer === undefined ? '' : `, heard "${answer}"`}`);
    received += 1;
  }
  await navigation.go_to(start);
}

const visitors = process.argv[2] ?? '1';
try {
  if (!/^[1-9]\d{0,5}$/.test(visitors)) throw new Error(`VISITORS is a whole number, 1 to 999999, not '${visitors}'`);
  const client = await connect(process.env['ROIS_URL'], { on_state: ({ state, reason }) => /connecting|lost/.test(state) && console.error(`reception: ${reason}`) });
  await receive(client, Number(visitors)).finally(() => client.close());
  console.log(`visitors received: ${visitors}`);
} catch (problem) {
  console.error(`reception: ${(problem as Error).message}`);
  process.exitCode = 1;
}
