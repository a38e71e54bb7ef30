// 500 commands with 20 events each while the link is cut; the same in Node and in a browser.
import { type Client, type ClientOptions, command } from 'rois-client';

export const commands = 500;
export const events_each = 20;

/** The outcome. */
export interface Endured {
  statuses: Record<string, number>; // number of commands by status
  events: number; // received
  out_of_order: number[]; // numbers of events that did not follow the one before: repeated or missed
  completed: number; // notifications
  completed_twice: string[];
  missed: number; // sum of the reported gaps
  other_gaps: number;
  resumed: number;
}

const options: ClientOptions = { first_delay: 5, most_delay: 50 };

export async function endure(connect: (url: string, options: ClientOptions) => Promise<Client>, url: string): Promise<Endured> {
  const client = await connect(url, options);
  const endured: Endured = { statuses: {}, events: 0, out_of_order: [], completed: 0, completed_twice: [], missed: 0, other_gaps: 0, resumed: 0 };
  const ended = new Set<string>();
  client.on('state', ({ state }) => (endured.resumed += state === 'resumed' ? 1 : 0));
  client.on('gap', (gap) => {
    if (gap.reason === 'lost') endured.missed += gap.count;
    else endured.other_gaps += 1;
  });
  client.on('notification', (one) => {
    if (one.name !== 'completed') return;
    endured.completed += 1;
    if (ended.has(one.command_id)) endured.completed_twice.push(one.command_id);
    ended.add(one.command_id);
  });
  await client.bind('navigation');
  const targets = await client.subscribe('reached_target');
  for (let sent = 0; sent < commands; ++sent) {
    // The robot's present position, written differently each time.
    const places = Array.from({ length: events_each }, (_, i) => `4000, 5000, ${sent * events_each + i}e-9`);
    const going = client.execute([command('navigation', 'start', { target_position: places })]);
    const [execution] = await Promise.all([going, sent % 10 === 0 ? client.query('robot_position') : undefined]);
    const status = await execution.status(30_000);
    endured.statuses[status] = (endured.statuses[status] ?? 0) + 1;
  }
  for (let target = await targets.next(200); target; target = await targets.next(endured.events < commands * events_each ? 1000 : 1)) {
    const number = Number(/(\d+)e-9$/.exec(target.results.text('target')!)![1]);
    if (number !== endured.events) endured.out_of_order.push(number);
    endured.events += 1;
  }
  await client.close();
  return endured;
}
