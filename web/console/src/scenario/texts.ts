// Texts of the panel and problems of a scenario.
import { type Both, text, text_of } from '../i18n/i18n';
import { type AttributeType, statuses, switchings } from './grammar';

const kinds_ja: Record<string, string> = { component: 'コンポーネント', variable: '変数', state: '状態' };

// Toolbar
export const start = text('Start', '開始');
export const stop = text('Stop', '停止');
export const open = text('Open …', '開く…');
export const save = text('Save', '保存');
export const shipped = text('Reception example', '付属の受付シナリオ');
export const shipped_hint = text('Opens the included reception scenario of figure 1', 'プログラムに付属する図 1 の受付シナリオを開きます');
export const undo = text('Undo', '元に戻す');
export const unnamed = text('Scenario', 'シナリオ');
export const not_connected = text('Connect first', '先に接続してください');
export const fix_first = text('Fix the problems first', '先に誤りを直してください');

// State of the run
export const never_run = text('Not started', '未開始');
export const binding = text('Binding …', 'バインド中…');
export const running = text('Running', '実行中');
export const ended = text_of((state: string) => [`Ended in “${state}”`, `「${state}」で終了`]);
export const failed = text_of((state: string) => [`Failed in ${state}`, `${state} で失敗`]);
export const was_stopped = text('Stopped', '停止しました');
export const trouble = text('Ended with an error', '問題が起きて終了');
export const for_so_long = text_of((time: string) => `(${time})`);

// Tabs
export const tabs = text('Parts of the scenario', 'シナリオの部分');
export const tab_run = text('Run', '実行');
export const tab_edit = text('Edit', '編集');
export const tab_xml = text('XML');

// The diagram
export const diagram = text('State diagram', '状態遷移図');
export const diagram_hint = text('Arrows move from state to state, Enter opens one for editing', '矢印キーで状態を移動し、Enter で編集します');
export const whole = text('Fit whole', '全体を表示');
export const natural = text('Readable size', '読みやすい大きさ');
export const state_name = text_of((name: string, leads: string) => [`State ${name}. ${leads}`, `状態 ${name}。${leads}`]);
export const leads_to = text_of((to: string, by: string) => [`${by}: to ${to}`, `${by}: ${to} へ`]);
export const is_current = text('current', '現在');
export const is_left = text('leaving', '退出中');
export const is_end = text('end', '終了');
export const is_failed = text('end, failed', '終了(失敗)');
export const starts_here = text('start', '開始');
export const visits = text_of((n: number) => [`entered ${n} ×`, `${n} 回入りました`]);
export const cannot_draw = text('It cannot be drawn until this is fixed:', '次を直すまで図にできません:');

// Run
export const history = text('History', '履歴');
export const no_history = text('Transitions and what the scenario prints appear here.', '遷移とシナリオの出力がここに現れます。');
export const variables = text('Variables', '変数');
export const no_variables = text('This scenario has no variables.', 'このシナリオに変数はありません。');
export const column_name = text('Name', '名前');
export const column_begins = text('Initial value', '初期値');
export const column_value = text('Holds', '現在の値');
export const begins_with = text_of((name: string) => [`Initial value of ${name}`, `${name} の初期値`]);
export const begins_hint = text('texts and triggers refer to them as {name}', '文字列やトリガーでは {name} と書きます');
export const nothing = text('nothing', '空');
export const printed = text('Printed', '出力');

// Edit
export const state = text('State', '状態');
export const scenario_itself = text('The scenario itself', 'シナリオ全体');
export const locked = text('Running. Stop it to edit.', '実行中です。変更するには停止してください。');
export const on_entering = text('When entered', '入るとき');
export const triggers = text('Triggers', 'トリガー');
export const triggers_hint = text('The first trigger whose conditions all hold is taken.', '条件がすべて成り立つ最初のものが次へ進めます。');
export const on_leaving = text('When left', '出るとき');
export const needed_components = text('Components', 'コンポーネント');
export const add_choose = text('Add …', '追加…');
export const remove = text_of((what: string) => [`Remove ${what}`, `${what}を削除`]);
export const earlier = text_of((what: string) => [`Move ${what} up`, `${what}を上へ`]);
export const later = text_of((what: string) => [`Move ${what} down`, `${what}を下へ`]);
export const add_state = text('Add a state', '状態を追加');
export const add_end = text('Add an end', '終了状態を追加');
export const remove_state = text('Remove this state', 'この状態を削除');
export const none_chosen = text('any', 'すべて');
export const not_given = text('not given', '指定なし');
export const value_of = text_of((what: string) => [`Text of ${what}`, `${what}の文字列`]);
export const text_with = text('text, with {variables}', '文字列。{変数} も使えます');
export const relation = text('holds when it', '条件');
export const more = text('More …', 'ほか…');
export const element = text_of((name: string) => elements[name] ?? name);
export const attribute = text_of((name: string) => attributes[name] ?? name);

// XML
export const xml_label = text('The scenario as XML', 'シナリオの XML');

// Problems
export const problems = text('Problems', '誤り');
export const warnings = text('Not supported by this engine', 'このエンジンにできないこと');
export const at_line = text_of((line: number, column: number) => [`line ${line}, column ${column}`, `${line} 行 ${column} 桁`]);
export const file_unreadable = text('The file cannot be read', 'ファイルを読めません');
export const unknown_element = text_of((name: string, parent: string, expected: readonly string[]) => [
  `unknown element '${name}' inside '${parent}': ${one_of(expected)}`,
  `'${parent}' の中に不明な要素 '${name}'。使えるもの: ${quoted(expected)}`,
]);
export const unknown_root = text_of((name: string, namespace: string) => [
  `unknown element '${name}' in the namespace '${namespace}'`,
  `名前空間 '${namespace}' に要素 '${name}' はありません`,
]);
export const other_namespace = text_of((name: string, parent: string, expected: string, namespace: string) => [
  `element '${name}' inside '${parent}' must be in the namespace '${expected}', not in '${namespace}'`,
  `'${parent}' の中の要素 '${name}' の名前空間は '${namespace}' ではなく '${expected}' です`,
]);
export const unknown_attribute = text_of((name: string, element: string, expected: readonly string[]) => [
  `unknown attribute '${name}' of '${element}'${expected.length > 0 ? `: ${one_of(expected)}` : ''}`,
  `'${element}' に属性 '${name}' はありません${expected.length > 0 ? `。使えるもの: ${quoted(expected)}` : ''}`,
]);
export const missing_attribute = text_of((name: string, element: string) => [
  `attribute '${name}' is missing in '${element}'`,
  `'${element}' に属性 '${name}' が必要です`,
]);
export const missing_element = text_of((names: readonly string[], element: string) => [
  names.length === 1 ? `element '${names[0]}' is missing in '${element}'` : `one of ${quoted(names)} is missing in '${element}'`,
  `'${element}' に次のいずれかが必要です: ${quoted(names)}`,
]);
export const element_out_of_order = text_of((name: string, parent: string, expected: readonly string[]) => [
  `element '${name}' inside '${parent}' is not allowed here${expected.length > 0 ? `: ${one_of(expected)}` : ''}`,
  `'${parent}' の中のここに '${name}' は書けません${expected.length > 0 ? `。使えるもの: ${quoted(expected)}` : ''}`,
]);
export const wrong_value = text_of((name: string, element: string, value: string, type: AttributeType) => [
  `attribute '${name}' of '${element}' has the value '${value}': expected ${forms[type]?.[0] ?? type}`,
  `'${element}' の属性 '${name}' の値 '${value}' は正しくありません。必要な形: ${forms[type]?.[1] ?? type}`,
]);
export const no_text_here = text_of((text: string, element: string) => [
  `text '${text}' inside '${element}', which may contain only elements`,
  `'${element}' の中に文字列 '${text}' は書けません。書けるのは要素だけです`,
]);
export const not_a_scenario = text_of((name: string) => [
  `this is not a robot scenario: expected the element robot_scenario, not '${name}'`,
  `ロボットシナリオではありません: 要素 '${name}' ではなく robot_scenario が必要です`,
]);
export const ref_or_type = text_of(() => [
  "a component has both 'ref' and 'type': give only one of them",
  "コンポーネントに 'ref' と 'type' の両方があります。一方だけを書いてください",
]);
export const duplicate = text_of((what: string, name: string) => [
  `duplicate ${what} '${name}'`,
  `${kinds_ja[what] ?? what} '${name}' が重複しています`,
]);
export const no_way_out = text_of(() => [
  "this state has no trigger: add one, or use the element 'end' instead of 'state'",
  "この状態にはトリガーがありません。トリガーを加えるか、要素 'state' の代わりに 'end' を使ってください",
]);
export const no_commands = text_of(() => [
  'this state waits for the end of its commands, and has none',
  'この状態はコマンドの終了を待ちますが、コマンドがありません',
]);
export const no_query = text_of(() => [
  'this state waits for an answer, and has no query',
  'この状態は応答を待ちますが、query がありません',
]);
export const nothing_to_take = text_of(() => [
  'only events and answers have results to take',
  '結果を取り出せるのはイベントと応答だけです',
]);
export const needs_list = text_of(() => ["'apart' needs 'not_in'", "'apart' には 'not_in' が必要です"]);
export const need_each_other = text_of((a: string, b: string) => [
  `'${a}' needs '${b}', and '${b}' needs '${a}'`,
  `'${a}' と '${b}' は一緒に使います`,
]);
export const one_relation = text_of((names: string) => [
  `a 'when' needs exactly one of ${names}`,
  `'when' には次のちょうど一つが必要です: ${names}`,
]);
export const no_such = text_of((what: string, name: string, known: string[]) => [
  `no ${what} '${name}'; there are ${known.join(', ')}`,
  `${kinds_ja[what] ?? what} '${name}' はありません。あるもの: ${known.join(', ')}`,
]);

// Endings
export const stopped = text('stopped', '停止しました');
export const session_ended = text('the session has ended, and its commands with it', 'セッションが終わり、ロボットの動作も終わりました');
export const connection_closed = text('the connection has closed', '接続が閉じられました');
export const no_place = text_of((text: string) => [
  `'${text}' is not a place: expected "x, y, th"`,
  `'${text}' は位置 "x, y, th" ではありません`,
]);
export const no_seconds = text_of((state: string, text: string) => [
  `${state}: '${text}' is not a number of seconds`,
  `${state}: '${text}' は秒数ではありません`,
]);
export const unexpected_end = text_of((state: string, status: string) => [
  `the commands of '${state}' ended with ${status}, and no trigger expects that`,
  `'${state}' のコマンドが ${status} で終わり、それに対するトリガーがありません`,
]);
export const no_component = text_of((ref: string) => [`the engine has no component '${ref}'`, `エンジンにコンポーネント '${ref}' がありません`]);
export const none_of_type = text_of((type: string) => [`the engine has no component of the type ${type}`, `エンジンに型 ${type} のコンポーネントがありません`]);
export const no_command = text_of((ref: string, type: string) => [`${ref} has no command '${type}'`, `${ref} にコマンド '${type}' はありません`]);
export const no_argument = text_of((ref: string, name: string, known: string[]) => [
  `${ref} has no argument '${name}'${known.length > 0 ? `; it has ${known.join(', ')}` : '; it has no arguments'}`,
  `${ref} に引数 '${name}' はありません${known.length > 0 ? `。あるもの: ${known.join(', ')}` : ''}`,
]);
export const not_of_type = text_of((name: string, value: string, type: string) => [
  `${name}: '${value}' is not of the type ${type}`,
  `${name}: '${value}' は型 ${type} ではありません`,
]);
export const one_value = text_of((name: string, type: string, count: number) => [
  `${name}: the type ${type} needs exactly one value, got ${count}`,
  `${name}: 型 ${type} の値はちょうど一つ必要ですが、${count} 個あります`,
]);
export const no_query_of = text_of((type: string) => [
  `no component of this engine answers the query '${type}'`,
  `このエンジンに問い合わせ '${type}' に答えるコンポーネントはありません`,
]);
export const no_event_of = text_of((type: string) => [
  `no matching component sends the event '${type}'`,
  `イベント '${type}' を通知するコンポーネントがありません`,
]);

// The forms of attribute values.
const a_name: Both = ["a name: letters, digits, '_', '.' and '-', not beginning with a digit", "名前(英数字、'_'、'.'、'-'。数字では始まりません)"];
const forms: Partial<Record<AttributeType, Both>> = {
  name: a_name,
  variable: a_name,
  component: a_name,
  state: a_name,
  result: a_name,
  status: [`one of ${statuses.join(', ')}`, `${statuses.join(', ')} のいずれか`],
  switching: [`one of ${switchings.join(', ')}`, `${switchings.join(', ')} のいずれか`],
  boolean: ['true or false', 'true か false'],
  double: ['a number', '数'],
  natural: ['a whole number, 0 or more, of 32 bits', '0 以上の 32 ビットの整数'],
};

function quoted(names: readonly string[]): string {
  return names.map((one) => `'${one}'`).join(', ');
}

function one_of(names: readonly string[]): string {
  return names.length === 1 ? `expected ${quoted(names)}` : `expected one of ${quoted(names)}`;
}

// Names of elements and attributes; the XML has its own.
const elements: Record<string, Both> = {
  event: ['event', 'イベント'],
  completed: ['commands completed', 'コマンド終了'],
  answered: ['query answered', '応答'],
  after: ['after seconds', '時間経過'],
  at_once: ['at once', 'ただちに'],
  set: ['set variable', '変数に代入'],
  add: ['add to list', 'リストに追加'],
  count: ['count up', '数える'],
  place: ['place before', '手前の位置'],
  print: ['print', '出力'],
  take: ['take result', '結果を取り出す'],
  when: ['condition', '条件'],
  command: ['command', 'コマンド'],
  query: ['query', '問い合わせ'],
  argument: ['argument', '引数'],
  component: ['component', 'コンポーネント'],
  variable: ['variable', '変数'],
  state: ['state', '状態'],
  end: ['end', '終了'],
  leaving: ['commands on leaving', '出るときのコマンド'],
};
const attributes: Record<string, Both> = {
  to: ['leads to', '行き先'],
  seconds: ['seconds', '秒'],
  status: ['status', '状態コード'],
  is_not: ['is not', '等しくない'],
  not_in: ['not in list', 'リストにない'],
  in: ['in list', 'リストにある'],
  near: ['near place', '近い位置'],
  within: ['within (mm)', '範囲 (mm)'],
  apart: ['apart (mm)', '間隔 (mm)'],
  beside: ['beside result', '対応する結果'],
  distance: ['distance (mm)', '距離 (mm)'],
  turn: ['turn (degrees)', '回転 (度)'],
  before: ['before place', '相手の位置'],
  delay: ['delay (ms)', '遅延 (ms)'],
  empty: ['empty', '空'],
  variable: ['variable', '変数'],
  component: ['component', 'コンポーネント'],
  type: ['type', '種類'],
  result: ['result', '結果'],
  is: ['is', '等しい'],
  name: ['name', '名前'],
  ref: ['ref', '参照'],
  start: ['start', '開始状態'],
  failed: ['failed', '失敗'],
  switching: ['switching', '切り替え'],
};
