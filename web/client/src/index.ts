// The API that browser.ts and node.ts share.
export { answer_text } from './answer_text.js';
export {
  component_profile_of,
  engine_profile_of,
  fault_of,
  identifier_of,
  is_notification,
  notification_of,
  parameter_of,
  results_of,
} from './answers.js';
export * from './client.js';
export * from './commands.js';
export * from './components.js';
export * from './conditions.js';
export * from './errors.js';
export * from './everything.js';
export { Completion, Execution } from './execution.js';
export type { State } from './link.js';
export * from './messages.js';
export * from './profiles.js';
export {
  component_ref_xml,
  condition_xml,
  namespaces,
  type Operation,
  parameter_xml,
  request,
  sequence_xml,
  type Writable,
} from './requests.js';
export type { OpenSocket, Socket, SocketEnd, SocketListener } from './socket.js';
export { Stream } from './stream.js';
export { Subscription, type Wanted } from './subscriptions.js';
export * from './values.js';
export * from './xml.js';
