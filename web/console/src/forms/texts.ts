import { text, text_of } from '../i18n/i18n';
import type { Kind, Problem } from './data_type';

const kinds: Record<Kind, readonly [en: string, ja: string]> = {
  integer: ['a whole number', '整数'],
  number: ['a number', '数'],
  bool: ['true or false', 'true または false'],
  text: ['text', '文字列'],
  date_time: ['a time such as 2026-11-20T12:00:00Z', '2026-11-20T12:00:00Z のような日時'],
  date: ['a day such as 2026-11-20', '2026-11-20 のような日付'],
  time: ['a time of day such as 12:00:00', '12:00:00 のような時刻'],
  identifier: ['a code', 'コード'],
  component_status: ['a component status', 'コンポーネントの状態'],
  stream_status: ['a stream status', 'ストリームの状態'],
};

export const problem = text_of((problem: Problem) => {
  switch (problem.what) {
    case 'missing':
      return ['Required.', '入力が必要です。'];
    case 'either':
      return [`Either this or ${problem.other} is required.`, `これか ${problem.other} のどちらかが必要です。`];
    case 'not_of_kind':
      return [`Enter ${kinds[problem.kind][0]}.`, `${kinds[problem.kind][1]}を入力してください。`];
    case 'out_of_range':
      return [
        `Enter a value from ${problem.least} to ${problem.most}.`,
        `${problem.least} から ${problem.most} までの値を入力してください。`,
      ];
    case 'unwritable':
      return ['It has a character that XML does not allow.', 'XML に書けない文字が含まれています。'];
  }
});
export const of_type = text_of((type: string) => [`Type ${type}.`, `型 ${type}。`]);
export const preset = text_of((value: string) => [`Default ${value}.`, `既定値 ${value}。`]);
export const left_out = text('leave it out', '省略');
export const now = text_of((value: string) => [`now ${value}`, `現在 ${value}`]);
export const position = text('x, y, th or a place', 'x, y, th または場所');
export const item = text_of((name: string, n: number) => [`${name}, item ${n}`, `${name} の ${n} 番目`]);
export const choose = text('Choose from a list', '一覧から選ぶ');
export const add = text_of((name: string) => [`Add to ${name}`, `${name} に追加`]);
export const remove = text_of((name: string, n: number) => [`Remove item ${n} of ${name}`, `${name} の ${n} 番目を削除`]);
export const send_empty = text_of((name: string) => [`Send ${name} as empty`, `${name} を空で送る`]);
export const is_empty = text('empty', '空');

