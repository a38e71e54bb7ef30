import { type Both, text, text_of } from '../i18n/i18n';
import type { CommandState } from '../state/session/commands_state';

const ends: Record<CommandState, Both> = {
  waiting: ['Waiting for its turn.', '順番を待っています。'],
  running: ['Running.', '実行中です。'],
  OK: ['Done.', '完了しました。'],
  ERROR: ['The component failed.', 'コンポーネントは実行できませんでした。'],
  ABORT: [
    'Aborted: it was stopped, its component was released or removed, or an earlier command failed.',
    '中断されました。stop、解放、コンポーネントの消失、または先行コマンドの失敗によります。',
  ],
  OUT_OF_RESOURCES: ['A required resource is in use.', '必要なものが使用中です。'],
  TIMEOUT: ['It exceeded its time limit.', '許された時間を超えました。'],
  unknown: ['The session was lost before it ended.', '終わる前にセッションが失われました。'],
};

export const send = text('Send', '送信');
export const none = text('The answer appears here.', 'ここに応答が表示されます。');
export const took = text_of((time: string) => [`Answered after ${time}`, `${time}後に応答`]);
export const request = text_of((title: string) => [`Request: ${title}`, `要求: ${title}`]);
export const answer = text_of((title: string) => [`Answer: ${title}`, `応答: ${title}`]);
export const results = text_of((title: string) => [`Results: ${title}`, `結果: ${title}`]);
export const name = text('Name', '名前');
export const value = text('Value', '値');
export const type = text('Type', '型');
export const ended = text_of((state: CommandState) => ends[state]);
export const lasts = text_of((time: string) => [`for ${time}`, `${time}間`]);
export const lasted = text_of((time: string) => [`(${time})`, `(${time})`]);
export const outside = text_of((text: string, x: string, y: string) => [
  `${text} is outside the map: ${x}, ${y} (mm).`,
  `${text} は地図の外です。地図の範囲は ${x}、${y} (mm) です。`,
]);
export const in_furniture = text_of((text: string) => [`${text} is inside furniture.`, `${text} には家具があります。`]);
export const in_use = text_of((components: string) => [`Running on the same robot: ${components}.`, `同じロボットで実行中: ${components}。`]);
export const reported_error = text_of((type: string) => [
  `The engine reported an error meanwhile: ${type}.`,
  `その間にエンジンがエラーを通知しました: ${type}。`,
]);
export const document_gone = text('The document is no longer stored.', '文書は残っていません。');
export const in_messages = text('Show in messages', 'メッセージで見る');
export const fetching = text('Fetching …', '取得中…');
export const gone = text_of((why: string) => [`Details are not available: ${why}`, `詳細を取得できません: ${why}`]);
export const stop = text('Stop', '停止');
export const stop_it = text_of((title: string) => [`Stop ${title}`, `${title} を停止`]);

