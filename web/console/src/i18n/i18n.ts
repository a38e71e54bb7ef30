// English and Japanese texts. Each part of the page has a `texts.ts` with both.
import { signal } from '@preact/signals';

export type Language = 'en' | 'ja';
export const languages: readonly { code: Language; name: string }[] = [
  { code: 'en', name: 'English' },
  { code: 'ja', name: '日本語' },
];

/** The language of the page. */
export const language = signal<Language>('en');

/** A text in English and Japanese, or one for both. */
export type Both = readonly [en: string, ja: string] | string;

/**
 * Defines a text of a `texts.ts`: `export const title = text('Health', '状態監視')`. Components call it while rendering, `texts.title()`,
 * and so are rendered again when the language changes.
 */
export function text(en: string, ja = en): () => string {
  return () => translated([en, ja]);
}

/** A text with arguments: `text_of((n: number) => [`${n} a second`, `毎秒 ${n}`])`. */
export function text_of<Given extends unknown[]>(made: (...given: Given) => Both): (...given: Given) => string {
  return (...given) => translated(made(...given));
}

/** Whether the main pointer is a finger. Texts then do not mention keys and mouse. */
export function is_touched(): boolean {
  return globalThis.matchMedia?.('(pointer: coarse)').matches ?? false;
}

function translated(both: Both): string {
  return typeof both === 'string' ? both : both[language.value === 'ja' ? 1 : 0];
}

/** The first supported language of the browser's preferences. */
export function wished_language(wishes: readonly string[]): Language {
  for (const wish of wishes) {
    if (wish.toLowerCase().startsWith('ja')) return 'ja';
    if (wish.toLowerCase().startsWith('en')) return 'en';
  }
  return 'en';
}

// --- Numbers and times, in the language of the page ---

/** `14:03:21.480`, in the browser's time zone. */
export function clock_time(at: number, with_ms = true): string {
  const date = new Date(at);
  const two = (n: number) => String(n).padStart(2, '0');
  const time = `${two(date.getHours())}:${two(date.getMinutes())}:${two(date.getSeconds())}`;
  return with_ms ? `${time}.${String(date.getMilliseconds()).padStart(3, '0')}` : time;
}

/** A time span: `0.4 s`, `12 s`, `3 min`, `2 h`. */
export function duration(ms: number): string {
  const japanese = language.value === 'ja';
  const written = (n: number, digits: number, en: string, ja: string) => {
    const text = n.toFixed(digits); // both languages use a decimal point; toLocaleString takes 1 ms
    return japanese ? `${text}${ja}` : `${text} ${en}`;
  };
  if (ms < 1000) return written(Math.max(0, Math.round(ms)), 0, 'ms', 'ミリ秒');
  if (ms < 9950) return written(ms / 1000, 1, 's', '秒');
  if (ms < 60_000) return written(Math.floor(ms / 1000), 0, 's', '秒');
  if (ms < 3_600_000) return written(Math.floor(ms / 60_000), 0, 'min', '分');
  return written(Math.floor(ms / 3_600_000), 0, 'h', '時間');
}

export function count_text(n: number): string {
  return n.toLocaleString(language.value);
}

/** `1.2 KiB` */
export function bytes_text(n: number): string {
  if (n < 1024) return `${n} B`;
  if (n < 1024 * 1024) return `${(n / 1024).toFixed(1)} KiB`;
  return `${(n / 1024 / 1024).toFixed(1)} MiB`;
}
