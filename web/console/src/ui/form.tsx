import type { JSX } from 'preact';

/** A form of the page: what stands in it is sent by `submit`, if by anything, and never by the browser. */
export function Form({ submit, ...native }: Omit<JSX.IntrinsicElements['form'], 'onSubmit'> & { submit?: (() => void) | undefined }) {
  return (
    <form
      noValidate
      {...native}
      onSubmit={(event) => {
        event.preventDefault();
        submit?.();
      }}
    />
  );
}
