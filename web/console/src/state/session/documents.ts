// All documents sent and received: the latest ones, with requests and answers paired.
import type { Environment } from '../base/environment';
import { type Direction, type DocumentKind, type DocumentLimits, DocumentLog, type LoggedDocument } from './document_log';

const usual_limits: DocumentLimits = { most: 20_000, most_bytes: 16 * 1024 * 1024 };

const root = /<((?:[\w.-]+:)?)([\w.-]+)([^>]*)/;
const a_component = /<(?:[\w.-]+:)?component_ref\s[^>]*?\bcode\s*=\s*["']([^"']*)["']/;
const the_sequence = /\ssequence\s*=\s*["'](\d+)["']/;
const the_subscription = /<(?:[\w.-]+:)?subscribe_id>([^<]*)</;
const the_return_code = /\sreturn_code\s*=\s*["'](\w+)["']/;
const notifications = ['receive_event', 'receive_error', 'completed', 'lost', 'profile_changed', 'switched'];

/** Called for each document. */
export interface DocumentListener {
  (document: LoggedDocument): void;
}

export class Documents {
  readonly ring: DocumentLog;
  /** Whether an event belongs to a subscription of the console itself. */
  is_own_subscription: (subscribe_id: string) => boolean = () => false;
  private waiting: { request: LoggedDocument; since: number }[] = []; // unanswered requests, in order; since: by the precise clock
  private next = 0;
  private asks_itself = false;
  private readonly listeners = new Set<DocumentListener>();

  constructor(
    private readonly environment: Environment,
    limits: DocumentLimits = usual_limits,
  ) {
    this.ring = new DocumentLog(limits);
  }

  /** Returns a function that removes the listener. */
  listen(listener: DocumentListener): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  /** Records a document sent or received. */
  note(direction: Direction, text: string): LoggedDocument {
    const document = described(this.next++, this.environment.now(), direction, text);
    document.is_own = direction === 'out' && (this.asks_itself || document.name === 'connect' || document.name === 'resume');
    if (document.name === 'receive_event') document.is_own = this.is_own_subscription(the_subscription.exec(text)?.[1] ?? '');
    if (direction === 'out') this.waiting.push({ request: document, since: this.environment.precise() });
    else if (document.kind !== 'notification') this.pair(document);
    this.ring.push(document);
    for (const listener of this.listeners) listener(document);
    return document;
  }

  /** Requests that `send` sends synchronously count as the console's own. */
  as_own<T>(send: () => T): T {
    const before = this.asks_itself;
    this.asks_itself = true;
    try {
      return send();
    } finally {
      this.asks_itself = before;
    }
  }

  /** The link is lost: pending requests get no answer. */
  forget_waiting(): void {
    this.waiting = [];
  }

  // Answers arrive in the order of requests.
  private pair(answer: LoggedDocument): void {
    const asked = this.waiting.shift();
    if (asked === undefined) return;
    const { request, since } = asked;
    answer.request = request;
    answer.is_own = request.is_own;
    answer.took = this.environment.precise() - since;
    if (answer.component === undefined && request.component !== undefined) answer.component = request.component;
  }
}

// Reads only the root, because hundreds may arrive in a second.
function described(number: number, at: number, direction: Direction, text: string): LoggedDocument {
  const [, , name = '', attributes = ''] = root.exec(text.startsWith('<?') ? text.slice(text.indexOf('?>') + 2) : text) ?? [];
  const document: LoggedDocument = { number, at, direction, kind: kind_of(direction, name), name, text, is_own: false };
  const component = a_component.exec(text)?.[1];
  if (component !== undefined) document.component = component;
  const sequence = the_sequence.exec(attributes)?.[1];
  if (sequence !== undefined) document.sequence = Number(sequence);
  const return_code = the_return_code.exec(attributes)?.[1];
  if (return_code !== undefined) document.return_code = return_code;
  return document;
}

function kind_of(direction: Direction, name: string): DocumentKind {
  if (direction === 'out') return 'request';
  if (name === 'fault') return 'fault';
  return notifications.includes(name) ? 'notification' : 'answer';
}
