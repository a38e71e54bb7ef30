import { type Both, text, text_of } from '../i18n/i18n';
import type { Problem } from './checking';
import type { Joining, Purpose } from './model';

const purposes: Record<Purpose, Both> = {
  search: ['Find components', 'コンポーネントを探す'],
  bind_any: ['Bind any', 'どれかをバインド'],
  subscribe: ['Subscribe', '購読'],
  query: ['Query', 'クエリ'],
};
const actions: Record<Purpose, Both> = {
  search: ['Search', '検索'],
  bind_any: ['Bind any', 'どれかをバインド'],
  subscribe: ['Subscribe', '購読'],
  query: ['Ask', '尋ねる'],
};
const joinings: Record<Joining, Both> = {
  all_of: ['all of', 'すべて成り立つ'],
  any_of: ['any of', 'どれか成り立つ'],
  none_of: ['none of', 'どれも成り立たない'],
  not_all_of: ['not all of', 'すべては成り立たない'],
};
// With the kind of area for spatial operators.
const operators: Record<string, Both> = {
  EqualTo: ['is', 'が等しい'],
  NotEqualTo: ['is not', 'が等しくない'],
  LessThan: ['is less than', 'がより小さい'],
  GreaterThan: ['is greater than', 'がより大きい'],
  LessThanOrEqualTo: ['is at most', 'が以下'],
  GreaterThanOrEqualTo: ['is at least', 'が以上'],
  Between: ['is between', 'が間にある'],
  Like: ['looks like', 'が似ている'],
  Null: ['has no value', 'に値がない'],
  After: ['is after', 'がより後'],
  Before: ['is before', 'がより前'],
  During: ['is between', 'が期間中'],
  Within_place: ['is within a place', 'が場所の中'],
  Within_box: ['is within a box', 'が範囲の中'],
  Within_point: ['is at a point', 'が点の上'],
  Intersects_place: ['touches a place', 'が場所に触れる'],
  Intersects_box: ['touches a box', 'が範囲に触れる'],
  Intersects_point: ['touches a point', 'が点に触れる'],
  Disjoint_place: ['is outside a place', 'が場所の外'],
  Disjoint_box: ['is outside a box', 'が範囲の外'],
  Disjoint_point: ['is not at a point', 'が点の上にない'],
  DWithin_place: ['is near a place', 'が場所の近く'],
  DWithin_box: ['is near a box', 'が範囲の近く'],
  DWithin_point: ['is near a point', 'が点の近く'],
  Beyond_place: ['is far from a place', 'が場所から遠い'],
  Beyond_box: ['is far from a box', 'が範囲から遠い'],
  Beyond_point: ['is far from a point', 'が点から遠い'],
};
const problems: Record<Problem, Both> = {
  no_reference: ['Choose a property', '対象を選んでください'],
  no_value: ['A value is missing', '値がありません'],
  no_number: ['Not a number', '数ではありません'],
  no_time: ['A time is missing', '時刻がありません'],
  no_place: ['A place is missing', '場所がありません'],
  no_box: ['Pick the box on the map, or type its corners', '地図で範囲を選ぶか、角を入力してください'],
  no_point: ['Pick the point on the map, or type it', '地図で点を選ぶか、入力してください'],
  no_distance: ['A distance is missing', '距離がありません'],
  reversed: ['The second value is before the first', '後のものが先のものより前です'],
  no_xml: ['Not a single XML element', '一つの XML 要素ではありません'],
  unwritable: ['The text contains a character that XML does not allow', 'テキストに XML で使えない文字が含まれています'],
};

export const purpose_named = text_of((purpose: Purpose) => purposes[purpose]);
export const action_named = text_of((purpose: Purpose) => actions[purpose]);
export const joining_named = text_of((joining: Joining) => joinings[joining]);
export const operator_named = text_of((operator: string) => operators[operator] ?? operator);
export const problem_named = text_of((problem: Problem) => problems[problem]);
export const heading = text('Condition', '条件');
export const purpose = text('Purpose', '用途');
export const event = text('Event', 'イベント');
export const query = text('Query', 'クエリ');
export const choose = text('choose …', '選んでください…');
export const clear = text('Clear', '消す');
export const paste = text('Paste XML', 'XML を貼り付け');
export const paste_title = text('A condition as XML', 'XML で書かれた条件');
export const paste_hint = text(
  'A Filter, predicate, condition, search, bind_any, subscribe or query. The prefixes fes and gml need no declaration.',
  'Filter、述語、condition、search、bind_any、subscribe、query。接頭辞 fes と gml の宣言は不要です。',
);
export const paste_take = text('Import', '取り込む');
export const paste_failed = text_of((why: string) => [`Invalid: ${why}`, `読めません: ${why}`]);
export const paste_no_condition = text('It has no Filter or SortBy that can be edited here', 'ここで編集できる Filter も SortBy もありません');
export const conditions = text('Conditions', '条件');
export const nothing_yet = text('No condition: matches all. Begin with', '条件なし: すべてが対象です。始めるには');
export const begin_type = text('a type of component', 'コンポーネントの種類');
export const begin_ready = text('ready and free', '準備完了で空いている');
export const begin_nearest = text('nearest first', '近い順');
export const begin_box = text_of((what: string) => [`${what} within a box`, `${what} が範囲の中`]);
export const begin_place = text_of((what: string) => [`${what} within a place`, `${what} が場所の中`]);
export const begin_near = text_of((what: string) => [`${what} near a point`, `${what} が点の近く`]);
export const begin_ref = text('one component', '一つのコンポーネント');
export const join = text('Which of these must be true', 'どれが成り立つべきか');
export const add_condition = text('Condition', '条件');
export const add_group = text('Group', 'グループ');
export const remove_group = text('Remove the group', 'グループを削除');
export const remove = text('Remove the condition', '条件を削除');
export const wrap = text('Put into a group', 'グループに入れる');
export const more = text('More: not, case of letters, lists', 'その他: 否定、大文字小文字、リスト');
export const negated = text('not', '否定');
export const negate = text('Must not be true', '成り立たないこと');
export const ignore_case = text('Ignore case', '大文字と小文字を区別しない');
export const of_list = text('Of several values', '複数の値のうち');
export const of_any = text('any', 'どれか');
export const of_all = text('all', 'すべて');
export const of_one = text('exactly one', 'ちょうど一つ');
export const reference = text('What', '対象');
export const operator = text('How', '比べ方');
export const value = text('Value', '値');
export const lower = text('from', 'から');
export const upper = text('to', 'まで');
export const pattern_hint = text('* any text, ? one character', '* は任意の文字列、? は一文字');
export const is_true = text('true');
export const is_false = text('false');
export const results = text('Results of the event or answer', 'イベントや応答の内容');
export const component = text('The component', 'コンポーネント');
export const parameters = text('Its parameters', 'パラメータ');
export const unknown_reference = text('Unknown here; the engine decides', 'ここでは未知です。エンジンが判断します');
export const as_xml = text('As XML', 'XML のまま');
export const place = text('Place', '場所');
export const distance = text('Distance', '距離');
export const corner = text_of((n: number, axis: string) => [`Corner ${n}, ${axis}`, `角 ${n} の ${axis}`]);
export const at = text_of((axis: string) => [`Point, ${axis}`, `点の ${axis}`]);
export const frame = text('Frame', '座標系');
export const frame_engine = text("the engine's", 'エンジンのもの');
export const pick_box = text('Drag on the map to pick the box, or type its corners.', '地図の上をドラッグして範囲を選ぶか、角を入力してください。');
export const pick_point = text('Click on the map to pick the point, or type it.', '地図をクリックして点を選ぶか、入力してください。');
export const pick_place = text('Click on a place of the map, or choose it by its name.', '地図の場所をクリックするか、名前で選びます。');
export const picker = text('Map to pick from', '選ぶための地図');
export const sort = text('Order', '順序');
export const sort_hint = text('Sorted by the first row; equal ones by the next.', '先に来るもの。等しいものの中では次の行で決まります。');
export const sort_by = text('By', '基準');
export const sort_value = text('value', '値');
export const sort_distance = text('distance from', 'からの距離');
export const add_sort = text('Order by', '並べる');
export const remove_sort = text('Remove from the order', '順序から外す');
export const ascending = text('ascending', '昇順');
export const descending = text('descending', '降順');
export const matches = text('Matches now', '今の一致');
export const matching = text_of((found: number, all: number) => [
  `${found} of ${all} ${all === 1 ? 'component' : 'components'}`,
  `${all} 個中 ${found} 個のコンポーネント`,
]);
export const can_match = text_of((n: number) => [
  n === 1 ? '1 component can send it' : `${n} components can send it`,
  `送れるコンポーネント ${n} 個`,
]);
export const can_answer = text_of((n: number) => [
  n === 1 ? '1 component can answer' : `${n} components can answer`,
  `答えられるコンポーネント ${n} 個`,
]);
export const on_results = text('Results are tested when an event or answer arrives.', 'イベントや応答の内容は、届いたときに調べられます。');
export const incomplete_request = text('Something is missing above.', '上にまだ未記入の項目があります。');
export const incomplete = text_of((n: number) => [
  n === 1 ? 'One condition is incomplete and ignored here.' : `${n} conditions are incomplete and ignored here.`,
  `${n} か所が未記入です。ここでは省かれています。`,
]);
export const looking = text('looking …', '検索中…');
export const found = text('Matching components', '一致するコンポーネント');
export const open_component = text('Open in Components', 'コンポーネントで開く');
export const request = text('Request', '要求');
export const details = text('Include results in events', 'イベントに結果を含める');
export const subscriptions = text('Subscriptions', '購読');
export const no_condition = text('without a condition', '条件なし');
export const events = text_of((n: number) => [n === 1 ? '1 event' : `${n} events`, `イベント ${n} 件`]);
export const last = text_of((ago: string) => [`the last ${ago} ago`, `最後は ${ago}前`]);
export const unsubscribe = text('Unsubscribe', '購読をやめる');
export const start_first = text('No events yet. A component sends events only while it runs:', 'まだ何も届いていません。コンポーネントは動いている間だけイベントを送ります:');
export const start = text_of((ref: string) => [`Start ${ref}`, `${ref} を開始`]);
export const started = text_of((ref: string) => [`${ref} runs`, `${ref} が動いています`]);

