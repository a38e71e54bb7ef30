import { type Both, is_touched, text, text_of } from '../i18n/i18n';

const layer_names: Record<string, Both> = {
  grid: ['Grid', '方眼'],
  places: ['Places', '場所'],
  frames: ['Frames', '座標系'],
  trails: ['Trails', '軌跡'],
  certainty: ['Certainty (95 %)', '確かさ(95 %)'],
  faces: ['Faces', '顔'],
  sounds: ['Sounds', '音'],
  names: ['Names', '名前'],
};
const kinds: Record<string, Both> = { robot: ['Robot', 'ロボット'], person: ['Person', '人'], face: ['Face', '顔'], sound: ['Sound', '音'] };
const obstacles: Record<string, Both> = {
  outside: ['This is outside the hall or too near to its edge.', 'ホールの外か、端に近すぎます。'],
  furniture: ['Furniture is in the way here.', 'ここには家具があります。'],
  wall: ['This is too near to a wall.', '壁に近すぎます。'],
};
const gone: Record<string, Both> = { robot: ['No news', '通知なし'], sound: ['Silent', '無音'] };

export const no_map = text('This engine has no map; showing an empty grid', 'このエンジンには地図がないため、方眼だけを表示しています');
export const map_trouble = text_of((reason: string) => [`The map could not be read (${reason})`, `地図を読み込めませんでした(${reason})`]);
export const reload = text('Try again', 'もう一度');
export const loading_map = text('Loading the map …', '地図を読み込んでいます…');
export const canvas = text(
  'Floor map: move the cursor with the arrow keys, Enter chooses; all keys are listed under Help',
  'フロアマップ: 矢印キーでカーソルを動かし、Enter で選びます。キーの一覧はヘルプにあります',
);

// Above the map
export const observe = text('Observe', '観察');
export const observe_hint = text(
  'Detects people, faces and sounds. Other applications cannot use these components meanwhile.',
  'エンジンが人・顔・音を探します。その間、ほかのアプリケーションはそのコンポーネントを使えません。',
);
export const observing = text_of((on: number, of: number) => [
  on === of ? `${on} components work` : `${on} of ${of} components work`,
  on === of ? `${on} 個が検出中` : `${of} 個中 ${on} 個が検出中`,
]);
export const observe_age = text_of((age: string) => [`news ${age} ago`, `通知 ${age}前`]);
export const observe_silent = text('no news yet', 'まだ通知なし');
export const observe_unlinked = text('not connected', '接続していません');
export const observe_blind = text('results do not arrive', '結果が届いていません');
export const observe_refused = text('Some things cannot be observed', '一部は観察できません');
export const observe_none = text('This engine cannot detect people', 'このエンジンには人を検出するものがありません');
export const go_to = text('Go to', '行き先');
export const go_to_place = text('Place to go to', '行き先の場所');
export const layers = text('Layers', '表示');
export const table = text('Table', '表');
export const help = text('Help', 'ヘルプ');
export const zoom_in = text('Larger', '拡大');
export const zoom_out = text('Smaller', '縮小');
export const fit = text('Show the whole floor', '全体を表示');
export const layer = text_of((name: string) => layer_names[name] ?? name);

// Reported things
export const kind = text_of((kind: string) => kinds[kind] ?? kind);
export const scale = text_of((length: string) => [`Scale: ${length}`, `縮尺: ${length}`]);
export const frame = text('Frame', '座標系');
export const not_live = text_of((age: string) => [`Not live: as it was ${age} ago`, `現在の様子ではありません: ${age}前`]);
export const nothing = text('Nothing to see yet', 'まだ何も見えません');
export const nobody_hint = text('No people are reported. Switch on Observe to detect people.', '人の情報がありません。「観察」を入れると、エンジンが人を探します。');
export const unplaced = text_of((n: number) => [`${n} in frames without a known place on the map`, `地図上の位置が分からない座標系に ${n} 件`]);
export const metres = text_of((m: string) => `${m} m`);
export const degrees = text_of((degrees: string) => `${degrees}°`);
export const at = text_of((x: string, y: string) => [`x ${x} m, y ${y} m`, `x ${x} m、y ${y} m`]);
export const near = text_of((name: string, away: string) => [`${name} ${away} away`, `${name} まで ${away}`]);

// Sending
export const send_title = text_of((robot: string) => [`Send ${robot}`, `${robot} を送る`]);
export const robot = text('Robot', 'ロボット');
export const place = text('Place', '場所');
export const point = text('Point on the floor', '床の上の点');
export const direction = text('Direction', '向き');
export const as_it_arrives = text('as it arrives', '着いたまま');
export const straight = text_of((away: string) => [`${away} away`, `直線で ${away}`]);
export const sent_as = text('sent as', '送る値');
export const give_up = text('Give up after', '制限時間');
export const never = text('never', 'なし');
export const no_gap = text('Enter a number above 0', '0 より大きい数値を入れてください');
export const no_number = text('Enter a number', '数値を入れてください');
export const send = text('Send here', 'ここへ送る');
export const cancel = text('Cancel', '取り消し');
export const turn_hint = text_of(() =>
  is_touched()
    ? ['Drag its arrow for the final direction', '矢印をドラッグして最後の向きを決めます']
    : ['Drag its arrow (or press Q, E) for the final direction', '矢印をドラッグするか Q・E キーで最後の向きを決めます'],
);
export const blocked = text_of((what: string) => obstacles[what] ?? what);
export const no_navigation = text('This engine has no component for navigation.', 'このエンジンには移動できるコンポーネントがありません。');
export const unlinked = text('The link is not open.', '接続していません。');
export const arrived = text_of((robot: string, where: string) => [`${robot} has reached ${where}`, `${robot} が ${where} に着きました`]);
export const stopped = text_of((robot: string) => [`${robot} was stopped`, `${robot} を止めました`]);
export const failed = text_of((what: string) => [`Not reached: ${what}`, `到達できませんでした: ${what}`]);
export const why = text('Why', '理由');
export const stop = text('Stop', '止める');
export const stop_robot = text_of((robot: string) => [`Stop ${robot}`, `${robot} を止める`]);

// Motions
export const moves_to = text_of((robot: string, where: string) => `${robot} → ${where}`);
export const follows = text_of((robot: string, whom: string) => [`${robot} follows ${whom}`, `${robot} が ${whom} を追っています`]);
export const moves = text_of((robot: string) => [`${robot} moves`, `${robot} が動いています`]);
export const by_others = text('by another application', 'ほかのアプリケーションによる');
export const waits = text('waits', '待機中');

// Selected thing
export const identified = text_of((ref: string) => [`Tracked as ${ref}`, `追跡名 ${ref}`]);
export const unidentified = text('Not identified', '未識別');
export const position = text('Position', '位置');
export const certainty = text('Certainty', '確かさ');
export const certain = text_of((about: string) => [`± ${about} (95 %)`, `± ${about}(95 %)`]);
export const uncertain = text('unknown', '不明');
export const reported = text('Reported', '通知');
export const ago = text_of((age: string) => [`${age} ago`, `${age}前`]);
export const reported_by = text('Reported by', '通知元');
export const freshness = text_of((state: string, kind: string, age: string) =>
  state === 'live' ? ['Seen now', '検出中']
  : state === 'quiet' ? [`Not moved for ${age}`, `${age}変化なし`]
  : state === 'old' ? [`No news for ${age}`, `${age}通知なし`]
  : state === 'unknown' ? ['Unknown', '不明']
  : gone[kind] ?? ['Out of sight', '見えません']);
export const state = text('State', '状態');
export const acts_for = text('Acts for', '担当');
export const own_frame = text('Own frame', '固有の座標系');
export const follow = text('Follow', '追う');
export const follow_whom = text_of((name: string) => [`Follow ${name}`, `${name} を追う`]);
export const distance = text('Distance', '距離');
export const gap = text('Distance to keep', '保つ間隔');
export const go_there = text('Go there', 'そこへ行く');
export const followed = text_of((robot: string, whom: string) => [
  `${robot} no longer follows ${whom}`,
  `${robot} は ${whom} を追うのをやめました`,
]);
export const follow_or_go = text(
  'Follow stays near a moving person. Go there sends the robot once, to their present place.',
  '「追う」は動きに合わせて付いて行き、「そこへ行く」は今いる場所へ一度だけ行きます。',
);
export const or_point = text('Or choose a point on the floor.', '床の上の点を選ぶこともできます。');
export const speak = text('Speak', '話す');
export const speak_hint = text('A sentence', '文を入力');
export const commands = text('All commands', 'できること一覧');
export const no_follow = text('This engine has no component for following.', 'このエンジンには追従できるコンポーネントがありません。');
export const close = text('Close', '閉じる');
export const choose = text('Choose', '選ぶ');

// The table
export const table_label = text('What is on the floor', '床の上にあるもの');
export const kind_column = text('Kind', '種類');
export const name = text('Name', '名前');

// Help
export const help_title = text('The floor map', 'フロアマップ');
export const keys = text('Keys, while the map has the focus', '地図にフォーカスがあるときのキー');
export const key_arrows = text(
  'move the cursor by 0.25 m; with Shift by 1 m; with Ctrl the map',
  'カーソルを 0.25 m 動かす。Shift で 1 m、Ctrl で地図を動かす',
);
export const key_enter = text(
  'selects the thing under the cursor, or sets the target there',
  'カーソルの下のものを選ぶ、または行き先にする',
);
export const key_turn = text('turn the target by 15°', '行き先の向きを 15° 回す');
export const key_send = text('sends the robot to the target', 'ロボットを行き先へ送る');
export const key_step = text('next and previous person or robot', '次・前の人やロボット');
export const key_zoom = text('zoom in, zoom out, whole floor', '拡大・縮小・全体');
export const key_escape = text('drops target, selection, cursor', '行き先・選択・カーソルを消す');
export const pointers = text_of(() => (is_touched() ? ['Fingers', '指'] : ['Mouse and fingers', 'マウスと指']));
export const pointer_click = text_of(() => [
  `${is_touched() ? 'Tap' : 'Click'} the floor for a target, drag its arrow to turn it. Nothing moves until you press Send here.`,
  `床を${is_touched() ? 'タップ' : 'クリック'}すると行き先になり、矢印をドラッグすると向きが変わります。「ここへ送る」を押すまで何も動きません。`,
]);
export const pointer_aim = text('Shift and drag: target and direction at once.', 'Shift を押しながらドラッグ: 行き先と向きを一度に決めます。');
export const pointer_pan = text_of(() =>
  is_touched()
    ? ['Drag the floor to move the map; two fingers zoom.', '床をドラッグすると地図が動き、二本指で拡大・縮小します。']
    : ['Drag the floor to move the map; wheel or two fingers to zoom.', '床をドラッグすると地図が動き、ホイールか二本指で拡大・縮小します。'],
);
export const signs = text('Signs', '記号');
export const sign_known = text('full: identified', '塗りつぶし: 識別済み');
export const sign_acts = text('with a ring: acts for a logical component', '輪つき: 論理コンポーネントを担当');
export const sign_gone = text('dashed: out of sight or outdated, with its age', '破線: 見えない、または古い(経過時間つき)');

