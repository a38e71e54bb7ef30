import { type Both, count_text, duration, text, text_of } from '../i18n/i18n';

const limit_names: Record<string, Both> = {
  sessions: ['Sessions', 'セッション'],
  connections: ['Connections', '接続'],
  commands: ['Commands of a session', 'セッションのコマンド'],
  subscribed_predicates: ['Predicates of a session', 'セッションの述語'],
  waiting_notifications: ['Waiting notifications of a session', 'セッションの未読通知'],
};
const trouble_names: Record<string, Both> = {
  rois_faults_total: ['Rejected messages', '受け付けられなかったメッセージ'],
  rois_commands_completed_total: ['Commands that did not end with OK', 'OK 以外で終わったコマンド'],
  rois_requests_total: ['Refused operations', '拒否された操作'],
  rois_errors_total: ['Notified errors', '通知されたエラー'],
  rois_connections_cut_total: ['Connections closed because of a slow reader', '読み取りが遅いため閉じた接続'],
  rois_notifications_lost_total: ['Notifications dropped because a session did not read', '読まれずに捨てた通知'],
  rois_stray_component_answers_total: ['Late or unexpected component answers', '遅れた、または宛先のないコンポーネントの応答'],
};

export const all = text('Health of the link, the gateway and the session', '接続・ゲートウェイ・セッションの状態');
export const none = text('–');
export const link = text('Link', '接続');
export const since = text_of((ms: number) => [`for ${duration(ms)}`, `${duration(ms)}間`]);
export const latency = text('Round trip', '往復時間');
export const requests = text('Requests', '要求');
export const sessions = text('Sessions', 'セッション');
export const connections = text('Connections', '接続数');
export const components = text('Components', 'コンポーネント');
export const memory = text('Memory', 'メモリー');
export const processor = text('Processor', 'プロセッサー');
export const files = text('Open files', '開いたファイル');
export const a_second = text_of((n: number) => [`${count_text(n)} /s`, `毎秒 ${count_text(n)}`]);
export const ms = text_of((n: number) => [`${n} ms`, `${n} ミリ秒`]);
export const share = text_of((n: number) => `${n} %`);
export const metrics_trouble = text_of((why: string) => [
  `The gateway's metrics are not available: ${why}. Older values follow.`,
  `ゲートウェイの数値を取得できません: ${why}。以下は最後に得た数値です。`,
]);
export const stale = text_of((age: string) => [`The gateway's metrics are ${age} old.`, `ゲートウェイの数値は${age}前のものです。`]);
export const no_metrics = text('No metrics from the gateway yet.', 'ゲートウェイの数値はまだありません。');
export const plots = text('The last minute', '直近 1 分');
export const latency_plot = text('Response time, ms', '応答にかかる時間（ミリ秒）');
export const middle = text('Round trip', '往復時間');
export const slowest = text('Slowest', '最も遅い応答');
export const inside = text('In the gateway', 'ゲートウェイ内');
export const slowest_was = text_of((what: string, ms: string) => [
  `Slowest in the last minute: ${what}, ${ms}.`,
  `直近 1 分で最も遅い応答: ${what}、${ms}。`,
]);
export const gateway_plot = text('The gateway, per second', 'ゲートウェイ（毎秒）');
export const notifications = text('Notifications', '通知');
export const fired = text('Events', 'イベント');
export const own_plot = text('This console, per second', 'このコンソール（毎秒）');
export const sent = text('Sent', '送信');
export const received = text('Received', '受信');
export const summary = text_of((line: string, most: string) => [`${line} at most ${most}`, `${line} 最大 ${most}`]);
export const as_table = text('As a table', '表で見る');
export const values_of = text_of((plot: string) => [`${plot}: values`, `${plot}: 値`]);
export const time = text('Time', '時刻');
export const session = text('Session', 'セッション');
export const mine = text('this console', 'このコンソール');
export const age = text('Age', '経過');
export const bound = text('Has bound', 'バインド中');
export const commands = text('Commands', 'コマンド');
export const subscriptions = text('Subscriptions', '購読');
export const waiting = text('Unread', '未読');
export const nothing_bound = text('nothing', 'なし');
export const sessions_without_details = text_of((n: string) => [
  `The gateway has ${n} sessions and gives no details. This console has bound:`,
  `ゲートウェイのセッションは ${n} 件で、詳しい情報はありません。このコンソールのバインド:`,
]);
export const limits = text('Limits', '上限');
export const limit = text('Limit', '上限の種類');
export const limit_name = text_of((name: string) => limit_names[name] ?? name);
export const now = text('Now', '現在');
export const most = text('At most', '上限値');
export const reached = text('Reached', '到達');
export const never = text('never', 'なし');
export const times = text_of((n: number) => [`${count_text(n)} ${n === 1 ? 'time' : 'times'}`, `${count_text(n)} 回`]);
export const lately = text_of((n: number) => [`${count_text(n)} lately`, `最近 ${count_text(n)}`]);
export const limits_unknown = text('This gateway does not report its limits.', 'このゲートウェイは上限を知らせません。');
export const troubles = text('Problems since the gateway started', 'ゲートウェイ開始以降の問題');
export const trouble_name = text_of((name: string) => trouble_names[name] ?? name);
export const what = text('What', '内容');
export const detail = text('Which', '種類');
export const count = text('Count', '件数');
export const in_minutes = text('Last two minutes', '直近 2 分');
export const no_troubles = text('Nothing.', 'ありません。');
export const log = text('Error log', 'エラーの記録');
export const no_log = text('No errors in this session.', 'このセッションにエラーの通知はありません。');
export const error = text('Error', 'エラー');
export const missed = text('Missed', '受信漏れ');
export const refused = text('Refused', '拒否');
export const command = text('Command', 'コマンド');
export const gap_lost = text_of((n: number) => [`${count_text(n)} notifications were lost`, `通知 ${count_text(n)} 件を失いました`]);
export const gap_session = text('The session was lost', 'セッションを失いました');
export const older = text_of((n: number) => [`Show ${count_text(n)} older`, `さらに古い ${count_text(n)} 件を表示`]);
export const details = text('Details', '詳細');
export const no_details = text('The engine gives no details.', 'エンジンからの詳しい情報はありません。');
export const request = text('The request', '要求');
export const document = text('The document', '文書');

