import { in_both } from '../i18n/i18n';

const doings: Record<string, readonly [en: string, ja: string]> = {
  enter: ['coming in', '入ってきます'],
  walk: ['walking', '歩いています'],
  say: ['saying', '話しています'],
  gesture: ['gesture', '身振りをしています'],
  leave: ['leaving', '帰ります'],
};
const gestures_ja: Record<string, string> = {
  wave: '手を振る', nod: 'うなずく', shake_head: '首を振る', bow: 'お辞儀', point: '指さす', raise_hand: '手を挙げる', clap: '拍手', thumbs_up: '親指を立てる',
};

export const words = in_both({
  title: ['Visitors', '来訪者'],
  none_here: ['This engine has no visitors to steer', 'このエンジンには動かせる来訪者がいません'],
  none_here_hint: ['People can be steered in the simulated hall. Start the gateway with', 'シミュレーションのホールでは人を動かせます。次を付けてゲートウェイを起動してください:'],
  nobody: ['Nobody is in the hall. Let somebody in.', 'ホールには誰もいません。誰かを入れてください。'],
  in_hall: (n: number) => [n === 1 ? '1 person in the hall' : `${n} people in the hall`, `ホールに ${n} 人`],
  // Coming in
  let_in: ['Let in', '入れる'],
  name: ['Name', '名前'],
  language: ['Language', '言語'],
  known: ['Identification knows them', '人物同定に登録済み'],
  name_taken: ['Somebody of this name is in the hall.', '同じ名前の人がホールにいます。'],
  name_wrong: ['A name without blanks, dots and colons.', '空白・ピリオド・コロンを含まない名前にしてください。'],
  // The map
  map: ['The hall. Visitors can be dragged to where they shall go.', 'ホール。来訪者をドラッグして行き先を決められます。'],
  map_hint: [
    'Arrows choose where to, Shift with arrows farther, Enter sends them, Escape thinks better of it.',
    '矢印キーで行き先を選び、Shift で大きく動かし、Enter で決定、Escape で取り消します。',
  ],
  visitor: (ref: string, at: string) => [`${ref}, at ${at}`, `${ref}、位置 ${at}`],
  robot: (ref: string) => [`Robot ${ref}`, `ロボット ${ref}`],
  click_hint: (ref: string) => [`Drag ${ref}, or click where to go`, `${ref} をドラッグするか、行き先をクリック`],
  sends: (ref: string, at: string) => [`${ref} goes to ${at}`, `${ref} は ${at} へ行きます`],
  metres: (x: string, y: string) => `${x} m, ${y} m`,
  // Who
  who: ['Who is in the hall', 'ホールにいる人'],
  is_known: ['known', '登録済み'],
  of_scenario: ['goes their own way', '自分で行動'],
  of_scenario_hint: ['Somebody of the engine’s own scenario: they cannot be steered.', 'エンジンのシナリオの人物なので動かせません。'],
  doing: (what: string) => doings[what] ?? what,
  choose_somebody: ['Choose somebody in the hall, or let somebody in.', 'ホールの誰かを選ぶか、誰かを入れてください。'],
  // What they do
  walk_to: ['Walk to', '行き先'],
  go: ['Go', '行く'],
  say: ['Say', '話す'],
  say_hint: ['What they say', '話す内容'],
  speak: ['Speak', '話す'],
  own_language: ['their own', '本人の言語'],
  gestures: ['Gestures', '身振り'],
  gesture: (name: string) => [name.replaceAll('_', ' '), gestures_ja[name] ?? name],
  leave: ['Leave the hall', 'ホールを出る'],
  not_done: (ref: string, what: string) => [`${ref} could not: ${doings[what]?.[0] ?? what}`, `${ref} はできませんでした: ${doings[what]?.[1] ?? what}`],
  // Time
  time: ['Time', '時間'],
  stands_still: ['The world stands still.', '世界は止まっています。'],
  stands_still_hint: ['What people and robots do goes on only while time passes.', '時間を進めている間だけ、人もロボットも動きます。'],
  pass: (seconds: string) => [`${seconds} s`, `${seconds} 秒`],
  pass_label: (seconds: number) => [seconds === 1 ? 'Let 1 second pass' : `Let ${seconds} seconds pass`, `${seconds} 秒進める`],
  flow: ['Let it flow', '流す'],
  halt: ['Halt', '止める'],
});
