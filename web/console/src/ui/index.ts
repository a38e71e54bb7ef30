// The widgets that all panels share.
export * from './button';
export * from './copy';
export * from './curl';
export * from './dialog';
export * from './error_text';
export * from './field';
export * from './icon';
export * from './split_pane';
export * from './states';
export * from './table';
export * from './tabs';
export * from './use_width';
export * from './virtual_list';
export * from './xml_text';
export * from './xml_view';
