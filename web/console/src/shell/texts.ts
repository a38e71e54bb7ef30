import { type Both, count_text, duration, text, text_of } from '../i18n/i18n';
import type { Phase } from '../state/session/link_state';

const phases: Record<Phase, Both> = {
  connecting: ['Connecting', '接続中'],
  open: ['Connected', '接続済み'],
  resumed: ['Connected again', '再接続しました'],
  lost: ['Connection lost', '接続が切れました'],
  refused: ['Refused', '拒否されました'],
  token: ['Token needed', 'トークンが必要です'],
  draining: ['Starting or stopping', '起動中または停止中'],
  closed: ['Disconnected', '切断しました'],
};

export const title = text('RoIS console', 'RoIS コンソール');
export const menu = text('Menu', 'メニュー');
export const skip = text('Skip to the panels', 'パネルへ移動');
export const phase = text_of((phase: Phase) => phases[phase]);
export const age = text_of((ms: number) => [`data ${duration(ms)} old`, `データは${duration(ms)}前`]);
export const is_old = text_of((ms: number) => [`The data is ${duration(Math.max(0, ms))} old.`, `表示は${duration(Math.max(0, ms))}前のものです。`]);
export const lost_hint = text('Reconnecting.', '再接続を試みています。');
export const connecting_hint = text(
  'The gateway does not answer yet. Retrying.',
  'ゲートウェイからまだ応答がありません。接続を試みています。',
);
export const draining_hint = text(
  'The gateway is starting or shutting down. The console connects as soon as possible.',
  'ゲートウェイは起動中か停止中です。可能になりしだい接続します。',
);
export const refused_hint = text(
  'The gateway refuses this console. Retrying every few seconds.',
  'ゲートウェイはこのコンソールを受け入れません。数秒ごとに試みます。',
);
export const closed_hint = text('The session has ended; its commands were stopped.', 'セッションは終了し、実行中のものは停止しました。');
export const missed_lost = text_of((n: number) => [
  `${count_text(n)} ${n === 1 ? 'notification was' : 'notifications were'} missed while disconnected.`,
  `接続が切れている間に通知 ${count_text(n)} 件を受け取れませんでした。`,
]);
export const missed_session = text(
  'The old session was lost. Its bindings and commands have ended; subscriptions were renewed. Events in between are unknown.',
  '前のセッションは失われました。バインドとコマンドは終了し、購読はやり直しました。その間に起きたことは分かりません。',
);
export const seen = text('Seen', '確認');
export const try_now = text('Try now', '今すぐ試す');
export const disconnect_title = text('Disconnect?', '切断しますか?');
export const disconnect_hint = text_of((bound: number, commands: number) => [
  `This ends the session${commands === 0 ? ' and' : ','} releases ${count_text(bound)} bound ${bound === 1 ? 'component' : 'components'}` +
    `${commands === 0 ? '' : ` and stops ${count_text(commands)} ${commands === 1 ? 'command' : 'commands'}`}.`,
  `セッションを終了します。バインドした ${count_text(bound)} 個のコンポーネントを解放${commands === 0 ? 'します' : `し、終わっていないコマンド ${count_text(commands)} 件を止めます`}。`,
]);
export const cancel = text('Cancel', '取り消し');
export const connect = text('Connect', '接続');
export const disconnect = text('Disconnect', '切断');
export const empty_engine = text('This engine has no components', 'このエンジンにはコンポーネントがありません');
export const empty_engine_hint = text('Components appear here when the engine gets some.', '追加されしだい、ここに現れます。');
export const bound = text_of((n: number) => [`${n} bound`, `バインド ${n}`]);
export const bound_title = text('Components that this console has bound', 'このコンソールがバインドしたコンポーネント');
export const release = text('Release', '解放');
export const release_all = text('Release all', 'すべて解放');
export const release_hint = text("Releasing a component stops this console's commands on it.", '解放すると、そこで実行中のものは停止します。');
export const none_bound = text('None. A component is bound when you first send it a command.', 'ありません。最初のコマンドを送るときにバインドします。');
export const token_title = text('This gateway requires a token', 'このゲートウェイにはトークンが必要です');
export const token_wrong = text('The gateway did not accept this token.', 'このトークンは受け入れられませんでした。');
export const token_label = text('Token', 'トークン');
export const token_hint = text(
  "Ask the gateway's operator. The token is kept until this page is closed.",
  'ゲートウェイの管理者に尋ねてください。このページを閉じるまで保持します。',
);
export const theme = text('Colours', '配色');
export const theme_system = text('System colours', '配色: システムに合わせる');
export const theme_dark = text('Dark colours', '配色: 暗い');
export const theme_light = text('Light colours', '配色: 明るい');
export const language = text('Language', '言語');
export const panels = text('Panels', 'パネル');
export const notices = text('Notices', 'お知らせ');
export const main = text('Main area', '主領域');
export const below = text('Lower area', '下の領域');
export const side = text('Side area', '横の領域');
export const stopped = text('Everything is stopped.', 'すべて停止しています。');
export const stopped_hint = text('Nothing starts until the stop is cleared.', '解除するまで何も動きません。');
export const not_confirmed = text_of((refs: string) => [`Not confirmed yet: ${refs}.`, `停止を確認できていません: ${refs}。`]);
export const clear = text('Clear', '解除');
export const clear_title = text('Clear the stop?', '停止を解除しますか?');
export const clear_hint = text('Commands of all sessions may start robots again.', 'すべてのセッションのコマンドがロボットを動かせるようになります。');
export const resume = text('Resume', '再開');
export const held = text_of((ref: string) => [`${ref} is held.`, `${ref} は一時停止しました。`]);

