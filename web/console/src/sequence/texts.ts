import { is_touched, text, text_of } from '../i18n/i18n';

const with_keys = (en: string, ja: string, keys: string, ja_keys: string) =>
  text_of(() => (is_touched() ? [en, ja] : [`${en} (${keys})`, `${ja} (${ja_keys})`]));

export const no_profile = text('No engine profile yet', 'エンジンについてまだ何も分かっていません');
export const empty = text(
  'No steps yet. Commands run one after the other; branches run at the same time.',
  'まだ何もありません。コマンドは順番に、分岐は同時に実行されます。',
);
export const begin_command = text('A command', 'コマンド');
export const begin_parallel = text('Two at the same time', '二つを同時に');
export const drawing = text('Drawing of the sequence', 'シーケンスの図');
export const steps = text('Steps', 'ステップ');
export const branch = text_of((n: number) => [`Branch ${n}`, `分岐 ${n}`]);
export const together = text_of((n: number) => [`${n} branches at once`, `${n} 分岐を同時に`]);
export const tools = text('Tools', '操作');
export const run = text('Run', '実行');
export const stop = text('Stop', '停止');
export const add = text('Add a step', 'ステップを追加');
export const add_here = text('Add a step here', 'ここにステップを追加');
export const duplicate = text('Duplicate the step', 'ステップを複製');
export const earlier = with_keys('Move the step forward', '前へ移す', 'Alt+Left', 'Alt+←');
export const later = with_keys('Move the step back', '後ろへ移す', 'Alt+Right', 'Alt+→');
export const up = with_keys('Move the step to the branch above', '上の分岐へ移す', 'Alt+Up', 'Alt+↑');
export const down = with_keys('Move the step to the branch below', '下の分岐へ移す', 'Alt+Down', 'Alt+↓');
export const remove = text('Remove the step (Delete)', 'ステップを削除 (Delete)');
export const undo = text('Undo (Ctrl+Z)', '元に戻す (Ctrl+Z)');
export const unnamed = text('unnamed', '名前なし');
export const sequences = text('Open or save …', '開く・保存…');
export const command = text('Command', 'コマンド');
export const wait = text('Wait', '待つ');
export const parallel = text('Branches', '分岐');
export const add_branch = text('Add a branch', '分岐を追加');
export const remove_branch = text_of((n: number) => [`Remove branch ${n}`, `分岐 ${n} を削除`]);
export const count = text_of((n: number) => [n === 1 ? '1 step' : `${n} steps`, `${n} ステップ`]);
export const no_component = text('Choose a component', 'コンポーネントを選んでください');
export const unknown_component = text('The engine does not have this component', 'エンジンにそのコンポーネントはありません');
export const no_command = text('Choose a command', 'コマンドを選んでください');
export const unknown_command = text('The component does not have this command', 'コンポーネントにそのコマンドはありません');
export const no_time = text('Enter a whole number of milliseconds', '整数のミリ秒が必要です');
export const no_branches = text('Its branches are empty', '分岐の中にまだ何もありません');
export const nothing = text('It has no command yet.', 'まだコマンドがありません。');
export const unknown_arguments_are = text_of((names: string) => [`Unknown arguments: ${names}.`, `このコマンドの引数ではありません: ${names}。`]);
export const drop_arguments = text('Remove them', '省く');
export const has_problem = text('not complete', '未完成');
export const refused = text('refused', '拒否');
export const parts = text('Step and XML', 'ステップと XML');
export const step = text('Step', 'ステップ');
export const component = text('Component', 'コンポーネント');
export const choose = text('choose …', '選んでください…');
export const delay = text('Waits before it starts', '開始までの待ち時間');
export const wait_time = text('How long', '時間');
export const choose_step = text('Choose a step to edit it', 'ステップを選ぶと内容が表示されます');
export const keys = text_of(() =>
  is_touched()
    ? ['The buttons above add, move and remove steps.', '上のボタンで追加・移動・削除できます。']
    : [
        'Arrows select a step, Alt and arrows move it, Insert adds one after it, Delete removes it, ' +
          'Enter opens its form. The mouse drags steps.',
        '矢印で移動、Alt+矢印で並べ替え、Insert で後ろに追加、Delete で削除、Enter で内容へ。マウスではドラッグできます。',
      ],
);
export const running = text('running', '実行中');
export const stopped = text('stopped', '停止');
export const left_queued = text_of((refs: string) => [
  `Released: ${refs}. Waiting commands there are aborted at their turn, but run if you bind the component again before. ` +
    'To end them at once, disconnect.',
  `解放済み: ${refs}。待っているものは順番が来ると中断されますが、先にバインドすると実行されます。すぐに終えるには切断してください。`,
]);
export const all_done = text_of((took: string) => [`Completed after ${took}.`, `${took}ですべて完了しました。`]);
export const done_of = text_of((done: number, all: number, took: string) => [
  `${done} of ${all} done, after ${took}.`,
  `${all} 個中 ${done} 個完了、${took}経過。`,
]);
export const failed = text_of((what: string, state: string) => [`${what} ended with ${state}.`, `${what} は ${state} で終わりました。`]);
export const show_step = text('Show the step', 'ステップを表示');
export const stays_bound = text_of((refs: string) => [`Still working and bound: ${refs}.`, `start の後も働き続けるものはバインドされたままです: ${refs}。`]);
export const this_one = text('This sequence', 'このシーケンス');
export const name = text('Name', '名前');
export const keep = text('Save in this browser', 'このブラウザに保存');
export const export_it = text('Export', '書き出す');
export const copy_xml = text('Copy XML', 'XML をコピー');
export const new_one = text('New', '新規');
export const kept = text('Saved in this browser', 'このブラウザに保存したもの');
export const none_kept = text('None yet. Name this one and save it.', 'まだありません。名前を付けて保存してください。');
export const open = text('Open', '開く');
export const open_it = text_of((name: string) => [`Open ${name}`, `${name} を開く`]);
export const drop_it = text_of((name: string) => [`Forget ${name}`, `${name} を忘れる`]);
export const import_it = text('Import', '読み込み');
export const file = text('An XML file', 'XML ファイル');
export const paste = text('Or XML text', 'またはその本文');
export const paste_hint = text('A CommandUnitSequence, or an execute that has one.', 'CommandUnitSequence、またはそれを含む execute。');
export const take = text('Import', '取り込む');
export const no_sequence = text('It has no CommandUnitSequence with commands', 'コマンドのある CommandUnitSequence がありません');
export const unreadable = text_of((reason: string) => [`Invalid: ${reason}`, `読めません: ${reason}`]);
export const request = text('The execute request as XML', 'XML としての execute 要求');
export const curl_hint = text(
  'The session must bind the components first; Run does that itself.',
  '先にセッションがコンポーネントをバインドしている必要があります。「実行」では自動です。',
);
export const resize = text('Size of the drawing', '図の大きさ');

