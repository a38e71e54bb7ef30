import { type Both, in_both } from '../i18n/i18n';
import type { CommandState } from '../state/commands_state';

const ends: Record<CommandState, Both> = {
  waiting: ['It waits for its turn.', '順番を待っています。'],
  running: ['It is running.', '実行中です。'],
  OK: ['It is done.', '完了しました。'],
  ERROR: ['The component could not do it.', 'コンポーネントは実行できませんでした。'],
  ABORT: ['It was stopped: by a stop, since its component was released or went away, or since what came before it failed.', '中断されました。stop、解放、コンポーネントの消失、または先行コマンドの失敗によります。'],
  OUT_OF_RESOURCES: ['Something that it needs is in use.', '必要なものが使用中です。'],
  TIMEOUT: ['It took longer than it was allowed to.', '許された時間を超えました。'],
  unknown: ['The session was lost before it ended.', '終わる前にセッションが失われました。'],
};

export const exchange_texts = in_both({
  send: ['Send', '送信'],
  none: ['The answer will stand here.', 'ここに応答が表示されます。'],
  took: (time: string) => [`after ${time}`, `${time}後`],
  request: (title: string) => [`Request: ${title}`, `要求: ${title}`],
  answer: (title: string) => [`Answer: ${title}`, `応答: ${title}`],
  results: (title: string) => [`Results: ${title}`, `結果: ${title}`],
  name: ['Name', '名前'],
  value: ['Value', '値'],
  type: ['Type', '型'],
  ended: (state: CommandState) => ends[state],
  lasts: (time: string) => [`for ${time}`, `${time}間`],
  lasted: (time: string) => [`(${time})`, `(${time})`],
  outside: (text: string, x: string, y: string) => [
    `${text} is outside of the map, which goes from ${x} and from ${y} (mm).`,
    `${text} は地図の外です。地図の範囲は ${x}、${y} (mm) です。`,
  ],
  in_furniture: (text: string) => [`${text} is where furniture stands.`, `${text} には家具があります。`],
  in_use: (components: string) => [`Running on the same robot: ${components}.`, `同じロボットで実行中: ${components}。`],
  told_error: (type: string) => [`The engine told of an error meanwhile: ${type}.`, `その間にエンジンがエラーを通知しました: ${type}。`],
  document_gone: ['The document is no longer remembered.', '文書は残っていません。'],
  in_messages: ['Show in messages', 'メッセージで見る'],
  fetching: ['Fetching …', '取得中…'],
  gone: (why: string) => [`The details cannot be had: ${why}`, `詳細を取得できません: ${why}`],
  stop: ['Stop', '停止'],
  stop_it: (title: string) => [`Stop ${title}`, `${title} を停止`],
});
