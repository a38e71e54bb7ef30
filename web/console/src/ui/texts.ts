import { in_both } from '../i18n/i18n';

export const texts = in_both({
  copy: ['Copy', 'コピー'],
  copied: ['Copied', 'コピーしました'],
  copy_failed: ['The browser did not allow it: select the text and copy it yourself', 'ブラウザが許可しませんでした。文字を選んでコピーしてください'],
  copy_as_curl: ['Copy as curl', 'curl としてコピー'],
  close: ['Close', '閉じる'],
  retry: ['Try again', 'もう一度'],
  loading: ['Loading …', '読み込み中…'],
  panel_failed: ['This panel has failed', 'このパネルに不具合が起きました'],
  panel_failed_hint: ['The other panels go on. What went wrong:', 'ほかのパネルは動いています。原因:'],
  resize: ['Resize', '大きさを変える'],
  required: ['required', '必須'],
  xml: ['XML document', 'XML 文書'],
  // Why a call failed, in words (RoisError.failure and return codes)
  refused: (what: string) => [`The engine refused: ${what}`, `エンジンが拒否しました: ${what}`],
  fault: (what: string) => [`The gateway could not take it: ${what}`, `ゲートウェイが受け付けませんでした: ${what}`],
  deadline: ['No answer came in time. Whether it was done is not known.', '時間内に応答がありませんでした。実行されたかどうかは分かりません。'],
  link_lost: ['The link broke before the answer came. Whether it was done is not known.', '応答の前に接続が切れました。実行されたかどうかは分かりません。'],
  session_lost: ['The session was lost, with its bindings, commands and subscriptions.', 'セッションが失われ、バインド・コマンド・購読もなくなりました。'],
  closed: ['The console is not connected.', 'コンソールは接続していません。'],
  out_of_resources: ['Another application has it. Try again when it has been released.', 'ほかのアプリケーションが使用中です。解放されてからもう一度試してください。'],
  unsupported: ['No component of this engine can do that.', 'このエンジンにそれができるコンポーネントはありません。'],
});
