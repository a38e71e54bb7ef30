import { type Both, bytes_text, clock_time, count_text, text, text_of } from '../i18n/i18n';
import type { Category } from './feed';

const names: Record<Category, Both> = {
  event: ['Events', 'イベント'],
  completed: ['Completed', '完了'],
  error: ['Errors', 'エラー'],
  notice: ['Others', 'その他'],
  request: ['Requests', '要求'],
  answer: ['Answers', '応答'],
};

export const list = text('Documents, newest last', '文書 (新しいものが下)');
export const category = text_of((name: Category) => names[name]);
export const kinds = text('Kinds', '種類');
export const component = text('Component', 'コンポーネント');
export const all_components = text('All components', 'すべてのコンポーネント');
export const search = text('Search in the text', '本文を検索');
export const own = text("Show the console's own requests", 'コンソール自身の問い合わせも表示');
export const pause = text('Pause', '一時停止');
export const go_on = text('Continue', '再開');
export const waiting = text_of((n: number) => [`${count_text(n)} new`, `新着 ${count_text(n)} 件`]);
export const shown = text_of((n: number, all: number) => [
  `${count_text(n)} of ${count_text(all)}`,
  `${count_text(all)} 件中 ${count_text(n)} 件`,
]);
export const shown_hint = text('Documents that match the filter, of all stored ones', 'コンソールに残る文書のうち、条件に合う件数');
export const export_it = text('Export all', 'すべて書き出す');
export const import_it = text('Open a recording', '記録を開く');
export const exported = text_of((n: number) => [
  `Saved all ${count_text(n)} stored documents, regardless of the filter. The command rois replay serves them as an engine.`,
  `文書 ${count_text(n)} 件を保存しました(絞り込みに関わらず、コンソールに残るすべて)。rois replay コマンドでエンジンとして再生できます。`,
]);
export const session_inside = text(
  "The file includes the console's own requests and the session id. During the session, anyone with the id can act as this console.",
  'コンソール自身の問い合わせも含みます。ファイルにはこのセッションの ID が含まれます。接続中は、それを持つ人がこのコンソールとして操作できます。',
);
export const import_failed = text_of((file: string) => [`${file} is not a valid recording`, `${file} を記録として読めません`]);
export const is_cut = text('The last line of the recording is incomplete and was ignored.', '記録の最後の行は途切れていたため、除きました。');
export const too_large = text_of((most: number) => [`It is larger than ${bytes_text(most)}.`, `${bytes_text(most)} を超えています。`]);
export const not_live = text('Not live.', 'ライブではありません。');
export const recording = text_of((file: string, n: number, begun: string, url: string) => [
  `Recording ${file}: ${count_text(n)} documents${begun === '' ? '' : `, begun ${begun}`}${url === '' ? '' : `, of ${url}`}.`,
  `記録 ${file} を表示しています: 文書 ${count_text(n)} 件${begun === '' ? '' : `、開始 ${begun}`}${url === '' ? '' : `、${url}`}。`,
]);
export const to_live = text('Back to live', '現在に戻る');
export const none = text('No documents yet', 'まだ何もやり取りされていません');
export const none_pass = text('No document matches the filter', '条件に合うものがありません');
export const only_own = text("Only the console's own requests so far", 'まだコンソール自身の問い合わせだけです');
export const clear = text('Show all', 'すべて表示');
export const pick = text('Choose a document', '文書を選ぶと内容を表示します');
export const outward = text('sent', '送信');
export const inward = text('received', '受信');
export const expired = text('expired', '期限切れ');
export const gap_lost = text_of((n: number) => [
  `The engine dropped ${count_text(n)} ${n === 1 ? 'notification' : 'notifications'}: its queue was full`,
  `通知 ${count_text(n)} 件がエンジンで破棄されました (待ちが多すぎました)`,
]);
export const gap_session = text(
  'The session was lost and a new one began. Events in between are unknown',
  'セッションが失われ、新しく始まりました。その間に起きたことは分かりません',
);
export const document = text_of((name: string) => [`Document: ${name}`, `文書: ${name}`]);
export const at = text_of((time: number) => clock_time(time));
export const took = text_of((ms: number) => [
  `answered after ${ms < 10 ? ms.toFixed(1) : Math.round(ms)} ms`,
  `${ms < 10 ? ms.toFixed(1) : Math.round(ms)} ミリ秒で応答`,
]);
export const size = text_of((bytes: number) => bytes_text(bytes));
export const to_request = text('Show request', '要求を見る');
export const to_answer = text('Show answer', '応答を見る');
export const to_component = text_of((ref: string) => [`Open ${ref}`, `${ref} を開く`]);
export const raw = text('As transmitted', '通信されたまま表示');
export const details = text('Details', '詳細');
export const fetch = text('Fetch the details', '詳細を取得');
export const fetching = text('Fetching …', '取得中…');
export const gone = text('The details are no longer available.', '詳細はもうありません。');
export const expires = text_of((time: string) => [`The engine keeps them until ${time}.`, `エンジンは ${time} まで保持します。`]);
export const not_kept = text('This event is too old: the console no longer stores it.', '古いイベントのため、コンソールは覚えていません。');
export const place = text_of((line: number, column: number) => [`line ${line}, column ${column}`, `${line} 行 ${column} 桁`]);

