import type { JSX } from 'preact';

/** A form that `submit` handles and the browser never sends. */
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
