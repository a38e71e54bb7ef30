import { in_both } from '../i18n/i18n';
import type { Kind, Problem } from './data_type';

const kinds_en: Record<Kind, string> = {
  integer: 'a whole number', number: 'a number', bool: 'true or false', text: 'a text', date_time: 'a time such as 2026-11-20T12:00:00Z',
  date: 'a day such as 2026-11-20', time: 'a time of day such as 12:00:00', identifier: 'a code',
  component_status: 'a status of components', stream_status: 'a status of streams',
};
const kinds_ja: Record<Kind, string> = {
  integer: '整数', number: '数', bool: 'true または false', text: '文字列', date_time: '2026-11-20T12:00:00Z のような日時',
  date: '2026-11-20 のような日付', time: '12:00:00 のような時刻', identifier: 'コード', component_status: 'コンポーネントの状態', stream_status: 'ストリームの状態',
};

export const texts = in_both({
  en: {
    problem: (problem: Problem) => {
      switch (problem.what) {
        case 'missing': return 'This is needed.';
        case 'either': return `Either this or ${problem.other} is needed.`;
        case 'not_of_kind': return `This has to be ${kinds_en[problem.kind]}.`;
        case 'out_of_range': return `This has to be between ${problem.least} and ${problem.most}.`;
        case 'unwritable': return 'There is a character in it that XML cannot hold.';
      }
    },
    of_type: (type: string) => `Type ${type}.`,
    preset: (value: string) => `Default ${value}.`,
    left_out: 'leave it out',
    now: (value: string) => `now ${value}`,
    position: 'x, y, th or a place',
    item: (name: string, n: number) => `${name}, item ${n}`,
    add: (name: string) => `Add to ${name}`,
    remove: (name: string, n: number) => `Remove item ${n} of ${name}`,
    send_empty: (name: string) => `Send ${name} as empty`,
    is_empty: 'empty',
  },
  ja: {
    problem: (problem: Problem) => {
      switch (problem.what) {
        case 'missing': return '入力が必要です。';
        case 'either': return `これか ${problem.other} のどちらかが必要です。`;
        case 'not_of_kind': return `${kinds_ja[problem.kind]}を入力してください。`;
        case 'out_of_range': return `${problem.least} から ${problem.most} までの値を入力してください。`;
        case 'unwritable': return 'XML に書けない文字が含まれています。';
      }
    },
    of_type: (type: string) => `型 ${type}。`,
    preset: (value: string) => `既定値 ${value}。`,
    left_out: '省略',
    now: (value: string) => `現在 ${value}`,
    position: 'x, y, th または場所',
    item: (name: string, n: number) => `${name} の ${n} 番目`,
    add: (name: string) => `${name} に追加`,
    remove: (name: string, n: number) => `${name} の ${n} 番目を削除`,
    send_empty: (name: string) => `${name} を空で送る`,
    is_empty: '空',
  },
});
