import { count_text, text, text_of } from '../i18n/i18n';

export const label = text('Time line of the link, commands, events and components', '接続・コマンド・イベント・コンポーネントのタイムライン');
export const help = text(
  'Arrow keys select things and stop time, Enter opens one. Plus, minus and the wheel zoom. ' +
    'Page Up and Page Down move in time, Home to the beginning, End to now. Space stops and continues. ' +
    'Dragging selects a time range, Backspace goes back.',
  '矢印キーで項目へ移動して時間を止め、Enter で開きます。+・-・ホイールで拡大・縮小、Page Up・Page Down で時間を移動、Home で最初、End で現在、Space で停止・再開。ドラッグで範囲を選び、Backspace で戻ります。',
);
export const live = text('Live', 'ライブ');
export const not_live = text('Not live', 'ライブではありません');
export const go_live = text('Go live', 'ライブに戻る');
export const pause = text('Stop time', '時間を止める');
export const held = text('Waits while you point', '指している間は停止');
export const stopped = text('Stopped', '停止中');
export const zoom_in = text('Zoom in', '拡大');
export const zoom_out = text('Zoom out', '縮小');
export const earlier = text('Earlier', '前へ');
export const later = text('Later', '後へ');
export const back = text('Previous range', '前の範囲に戻る');
export const everything = text('Everything', 'すべて');
export const stretch = text('Time range', '時間の範囲');
export const hide_quiet = text('Hide quiet components', '動きのないコンポーネントを隠す');
export const with_own = text('Console’s own events', 'コンソール自身のイベント');
export const as_table = text('As a table', '表で見る');
export const lanes = text('Lanes', 'レーン');
export const link = text('Link', '接続');
export const commands = text('Commands', 'コマンド');
export const events = text('Events and errors', 'イベントとエラー');
export const nothing = text('Nothing in this time range', 'この時間の範囲には何もありません');
export const shown_of = text_of((shown: number, all: number) => [
  `The last ${count_text(shown)} of ${count_text(all)} in this time range.`,
  `この範囲の ${count_text(all)} 件のうち最後の ${count_text(shown)} 件です。`,
]);
export const details = text('Details', '詳細');
export const open = text_of((what: string) => [`Open: ${what}`, `開く: ${what}`]);
export const close = text('Close the details', '詳細を閉じる');

// Kinds of things
export const command = text('Command', 'コマンド');
export const event = text('Event', 'イベント');
export const error = text('Error', 'エラー');
export const refused = text('Refused', '拒否');
export const switched = text('Switched', '切り替え');
export const gap = text('Missed', '受信漏れ');
export const status = text('Status', '状態');
export const holder = text('Bound', 'バインド');
export const many = text_of((n: number) => [`${count_text(n)} events and errors`, `イベントとエラー ${count_text(n)} 件`]);
export const by_me = text('by this console', 'このコンソール');
export const by_session = text_of((session: string) => [`by session ${session}`, `セッション ${session}`]);
export const gap_lost = text_of((n: number) => [`${count_text(n)} notifications were lost`, `通知 ${count_text(n)} 件を失いました`]);
export const gap_session = text('The session was lost', 'セッションを失いました');

// Descriptions
export const when = text('Time', '時刻');
export const what = text('Content', '内容');
export const component = text('Component', 'コンポーネント');
export const state = text('State', '状態');
export const lasted = text('Lasted', '長さ');
export const from = text('From', '開始');
export const to = text('Until', '終了');
export const goes_on = text('continues', '継続中');
export const sent = text('Sent', '送信');
export const began = text('Began', '実行開始');
export const ended = text('Ended', '終了');
export const not_yet = text('not yet', 'まだ');
export const not_seen = text('not seen', '確認できず');
export const waited = text('Waited', '待ち時間');
export const ran = text('Ran', '実行時間');
export const arguments_of = text('Arguments', '引数');
export const results = text('Results', '結果');
export const no_results = text('No results.', '結果はありません。');
export const place = text('Place in its sequence', 'シーケンス内の位置');
export const expires = text('Details kept until', '詳細の保持期限');
export const expired = text('The engine no longer has the details.', 'エンジンは詳細を保持していません。');
export const document = text('The document', '文書');
export const request = text('The request', '要求');
export const zoom_here = text('Zoom to it', 'ここを拡大');
export const reason = text('Reason', '理由');

