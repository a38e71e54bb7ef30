// Forms that are made from profiles: fields, checks, and the arguments that come of them.
export * from './argument_fields';
export * from './data_type';
export * from './describe';
export * from './inputs';
export * from './options';
export * from './parameter_field';
export { texts as form_texts } from './texts';
