// A scenario as a graph: one edge for each pair of states connected by triggers.
import type { Scenario, Trigger } from './model';

export interface Edge {
  from: string;
  to: string;
  /** In order; all have the same source and target. */
  triggers: Trigger[];
}

export interface Graph {
  states: string[]; // in document order
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

/** A short label for a trigger, with names of the document. */
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
