import { in_both } from '../i18n/i18n';

export const texts = in_both({
  en: {
    title: 'Components',
    tree: 'Engines and components',
    none: 'Nothing is known of the engine yet',
    mine: 'bound by me',
    other: (session: string) => `bound by session ${session}`,
    unasked: 'has no status',
  },
  ja: {
    title: 'コンポーネント',
    tree: 'エンジンとコンポーネント',
    none: 'エンジンについてまだ何も分かっていません',
    mine: '自分がバインド',
    other: (session: string) => `セッション ${session} がバインド`,
    unasked: '状態なし',
  },
});
