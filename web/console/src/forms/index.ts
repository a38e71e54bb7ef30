// Forms made from profiles: fields, validation, arguments, requests and their outcomes.
export * from './argument_fields';
export * from './command_progress';
export * from './data_type';
export * from './describe';
export * from './drafts';
export * from './exchange';
export * from './inputs';
export * from './logged';
export * from './options';
export * from './parameter_field';
export * from './results_table';
export * as form_texts from './texts';
export * as exchange_texts from './exchange_texts';
export * from './why';
