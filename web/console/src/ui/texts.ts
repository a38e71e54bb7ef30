import { text, text_of } from '../i18n/i18n';

export const copy = text('Copy', 'コピー');
export const copied = text('Copied', 'コピーしました');
export const copy_failed = text('The browser did not allow it: select and copy the text yourself', 'ブラウザが許可しませんでした。文字を選んでコピーしてください');
export const copy_as_curl = text('Copy as curl', 'curl としてコピー');
export const close = text('Close', '閉じる');
export const retry = text('Try again', 'もう一度');
export const loading = text('Loading …', '読み込み中…');
export const panel_failed = text('This panel has failed', 'このパネルに不具合が起きました');
export const panel_failed_hint = text(
  'The other panels still work. If it fails again, reload the page. Error:',
  'ほかのパネルは動いています。再び失敗する場合は、ページを再読み込みしてください。原因:',
);
export const resize = text('Resize', '大きさを変える');
export const required = text('required', '必須');
export const xml = text('XML document', 'XML 文書');

// Why a call failed, in words (RoisError.failure and return codes)
export const refused = text_of((what: string) => [`The engine refused: ${what}`, `エンジンが拒否しました: ${what}`]);
export const fault = text_of((what: string) => [`The gateway rejected it: ${what}`, `ゲートウェイが受け付けませんでした: ${what}`]);
export const deadline = text(
  'No answer in time. The operation may or may not have run.',
  '時間内に応答がありませんでした。実行されたかどうかは分かりません。',
);
export const link_lost = text(
  'The connection broke before the answer. The operation may or may not have run.',
  '応答の前に接続が切れました。実行されたかどうかは分かりません。',
);
export const session_lost = text(
  'The session was lost, with its bindings, commands and subscriptions.',
  'セッションが失われ、バインド・コマンド・購読もなくなりました。',
);
export const closed = text('The console is not connected.', 'コンソールは接続していません。');
export const out_of_resources = text(
  'Another application has bound it. Try again when it is released.',
  'ほかのアプリケーションが使用中です。解放されてからもう一度試してください。',
);
export const unsupported = text('No component of this engine can do that.', 'このエンジンにそれができるコンポーネントはありません。');
export const stop_all = text('STOP', '停止');
export const stop_all_title = text('STOP everything: all robots, of all sessions', '停止: すべてのセッションのすべてのロボットを止めます');
export const not_stopped = text_of((why: string) => [`Not stopped: ${why}`, `停止できませんでした: ${why}`]);
