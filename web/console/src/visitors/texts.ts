import { text, text_of } from '../i18n/i18n';

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

export const none_here = text('This engine has no visitors to control', 'このエンジンには動かせる来訪者がいません');
export const none_here_hint = text(
  'Visitors can be controlled in the simulated hall. Start the gateway with',
  'シミュレーションのホールでは人を動かせます。次を付けてゲートウェイを起動してください:',
);
export const nobody = text('The hall is empty. Let a visitor in.', 'ホールには誰もいません。誰かを入れてください。');
export const in_hall = text_of((n: number) => [n === 1 ? '1 person in the hall' : `${n} people in the hall`, `ホールに ${n} 人`]);
export const not_known = text('The people in the hall are not known yet', 'ホールに誰がいるかはまだ分かりません');
export const as_it_was = text_of((age: string) => [`Not connected: as it was ${age} ago`, `接続していません: ${age}前の様子`]);

// Coming in
export const let_in = text('Let in', '入れる');
export const name = text('Name', '名前');
export const language = text('Language', '言語');
export const known = text('Known to identification', '人物同定に登録済み');
export const name_taken = text('This name is already used.', '同じ名前の人がいます。');
export const name_wrong = text('Use a name without spaces, dots and colons.', '空白・ピリオド・コロンを含まない名前にしてください。');

// The map
export const map = text('The hall. Drag visitors to their targets.', 'ホール。来訪者をドラッグして行き先を決められます。');
export const map_hint = text(
  'Arrows choose the target, with Shift in larger steps. Enter confirms, Escape cancels.',
  '矢印キーで行き先を選び、Shift で大きく動かし、Enter で決定、Escape で取り消します。',
);
export const visitor = text_of((ref: string, at: string) => [`${ref}, at ${at}`, `${ref}、位置 ${at}`]);
export const robot = text_of((ref: string) => [`Robot ${ref}`, `ロボット ${ref}`]);
export const click_hint = text_of((ref: string) => [`Drag ${ref}, or click the target`, `${ref} をドラッグするか、行き先をクリック`]);
export const sends = text_of((ref: string, at: string) => [`${ref} goes to ${at}`, `${ref} は ${at} へ行きます`]);
export const metres = text_of((x: string, y: string) => `${x} m, ${y} m`);

// People
export const who = text('People in the hall', 'ホールにいる人');
export const is_known = text('known', '登録済み');
export const of_scenario = text('follows the scenario', '自分で行動');
export const of_scenario_hint = text('A person of the engine’s scenario, who cannot be controlled.', 'エンジンのシナリオの人物なので動かせません。');
export const doing = text_of((what: string) => doings[what] ?? what);
export const waits = text('comes in when the entrance is free', '入口が空いたら入ります');
export const choose_somebody = text('Choose a person in the hall, or let a visitor in.', 'ホールの誰かを選ぶか、誰かを入れてください。');

// Actions
export const walk_to = text('Walk to', '行き先');
export const go = text('Go', '行く');
export const say = text('Say', '話す');
export const say_hint = text('Text to say', '話す内容');
export const speak = text('Speak', '話す');
export const own_language = text('their own', '本人の言語');
export const gestures = text('Gestures', '身振り');
export const gesture = text_of((name: string) => [name.replaceAll('_', ' '), gestures_ja[name] ?? name]);
export const leave = text('Leave the hall', 'ホールを出る');
export const not_done = text_of((ref: string, what: string) => [
  `${ref} could not: ${doings[what]?.[0] ?? what}`,
  `${ref} はできませんでした: ${doings[what]?.[1] ?? what}`,
]);

// Time
export const time = text('Time', '時間');
export const stands_still = text('Time is stopped.', '世界は止まっています。');
export const stands_still_hint = text('People and robots move only while time passes.', '時間を進めている間だけ、人もロボットも動きます。');
export const pass = text_of((seconds: string) => [`${seconds} s`, `${seconds} 秒`]);
export const pass_label = text_of((seconds: number) => [
  seconds === 1 ? 'Let 1 second pass' : `Let ${seconds} seconds pass`,
  `${seconds} 秒進める`,
]);
export const flow = text('Let time run', '流す');
export const halt = text('Halt', '止める');

