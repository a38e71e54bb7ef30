import { duration, text, text_of } from '../i18n/i18n';

export const tree = text('Engines and components', 'エンジンとコンポーネント');
export const none = text('No engine profile yet', 'エンジンについてまだ何も分かっていません');
export const pick = text('Choose a component', 'コンポーネントを選んでください');
export const empty = text('This engine has no components', 'このエンジンにはコンポーネントがありません');
export const gone = text_of((ref: string) => [`There is no component ${ref}`, `コンポーネント ${ref} は今ありません`]);
export const mine = text('bound by me', '自分がバインド');
export const other = text_of((session: string) => [
  session === '' ? 'bound by another session' : `bound by session ${session}`,
  session === '' ? '別のセッションがバインド' : `セッション ${session} がバインド`,
]);
export const nobody = text('not bound', 'バインドなし');
export const running = text('running', '実行中');
export const runs = text_of((name: string) => [`The command ${name} is running.`, `コマンド ${name} を実行中です。`]);
export const goes_on = text('Started. It works until it is stopped or released.', '開始済みです。停止または解放するまで動作します。');
export const unasked = text('no status', '状態なし');
export const members = text('Members', 'メンバー');
export const acts = text('acts', '動作中');
export const bind = text('Bind', 'バインド');
export const release = text('Release', '解放');
export const bind_it = text_of((ref: string) => [`Bind ${ref}`, `${ref} をバインド`]);
export const release_it = text_of((ref: string) => [`Release ${ref}`, `${ref} を解放`]);
export const since = text_of((ms: number) => [`for ${duration(ms)}`, `${duration(ms)}間`]);
export const unresolved = text_of((urns: string) => [`Unknown included profiles: ${urns}`, `含まれるプロファイルが不明です: ${urns}`]);
export const of_component = text_of((ref: string) => [`Messages of ${ref}`, `${ref} のメッセージ`]);
export const commands = text('Commands', 'コマンド');
export const parameters = text('Parameters', 'パラメータ');
export const queries = text('Queries', '問い合わせ');
export const events = text('Events', 'イベント');
export const no_commands = text('No commands.', 'コマンドはありません。');
export const no_parameters = text('No parameters.', 'パラメータはありません。');
export const no_queries = text('No queries.', '問い合わせはありません。');
export const no_events = text('No events.', 'イベントはありません。');
export const choose_command = text('Command', 'コマンド');
export const choose_query = text('Query', '問い合わせ');
export const choose_event = text('Event', 'イベント');
export const start_within = text_of((time: string) => [`It must start within ${time}.`, `${time}以内に開始しなければなりません。`]);
export const given_back = text('Release the component when the command ends, so that others can use it', 'コマンドが終わったら解放し、ほかが使えるようにする');
export const values_now = text('Current values', '現在の値');
export const set = text('Set', '設定');
export const set_title = text('Set values', '値を変える');
export const set_nothing = text('Nothing entered yet.', 'まだ何も入力されていません。');
export const no_values = text('No parameters returned.', 'パラメータを返しません。');
export const answers = text_of((names: string) => [`Returns: ${names}`, `応答: ${names}`]);
export const brings = text_of((names: string) => [`Results: ${names}`, `内容: ${names}`]);
export const subscribe = text('Subscribe', '購読');
export const only_mine = text_of((ref: string) => [`Only from ${ref}`, `${ref} からのものだけ`]);
export const inline = text('Include results', '値も受け取る');
export const condition = text('Further condition (Filter Encoding, optional)', '追加の条件 (Filter Encoding、省略可)');
export const condition_bad = text_of((why: string) => [`Invalid XML: ${why}`, `XML ではありません: ${why}`]);
export const subscriptions = text('Active subscriptions', '購読中');
export const unsubscribe = text('Unsubscribe', '購読をやめる');
export const unsubscribe_it = text_of((id: string) => [`Unsubscribe ${id}`, `${id} の購読をやめる`]);
export const counted = text_of((n: number) => [n === 1 ? '1 event' : `${n} events`, `イベント ${n} 件`]);
export const last_events = text('Latest events', '最近のイベント');
export const not_started = text('Events arrive only after start.', 'イベントは start の後にだけ届きます。');

