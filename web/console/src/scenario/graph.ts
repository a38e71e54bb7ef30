// A scenario as a graph: its states, and an edge for each pair of states that triggers lead between.
import type { Scenario, Trigger } from './model';

export interface Edge {
  from: string;
  to: string;
  /** In their order; those of one edge lead from the same state to the same state. */
  triggers: Trigger[];
}

export interface Graph {
  states: string[]; // in their order in the document
  start: string;
  edges: Edge[];
}

export function graph_of(scenario: Scenario): Graph {
  const edges: Edge[] = [];
  for (const { name, triggers } of scenario.states.values())
    for (const trigger of triggers) {
      const known = edges.find((one) => one.from === name && one.to === trigger.to);
      if (known) known.triggers.push(trigger);
      else edges.push({ from: name, to: trigger.to, triggers: [trigger] });
    }
  return { states: [...scenario.states.keys()], start: scenario.start, edges };
}

/** What a trigger waits for, as short as an edge needs it. Names are those of the document. */
export function label_of({ kind, event_type, status, seconds }: Trigger): string {
  if (kind === 'event') return event_type;
  if (kind === 'completed') return status === undefined ? 'completed' : `completed ${status}`;
  if (kind === 'after') return `after ${seconds} s`;
  return kind === 'answered' ? 'answered' : 'at once';
}

export function label_of_edge({ triggers }: Edge): string {
  const labels = triggers.map(label_of);
  const [first = ''] = labels;
  if (labels.every((one) => one === first)) return labels.length > 1 ? `${first} ×${labels.length}` : first;
  return labels.length > 2 ? `${first} +${labels.length - 1}` : labels.join(', ');
}
