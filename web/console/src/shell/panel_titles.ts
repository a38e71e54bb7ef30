// Titles of the panels, for the navigation and the panels themselves.
import { text } from '../i18n/i18n';

export const map = text('Floor map', 'フロアマップ');
export const sequence = text('Sequences', 'シーケンス');
export const conditions = text('Conditions', '条件');
export const scenario = text('Scenario', 'シナリオ');
export const timeline = text('Time line', 'タイムライン');
export const messages = text('Events and messages', 'イベントとメッセージ');
export const components = text('Components', 'コンポーネント');
export const visitors = text('Visitors', '来訪者');
export const health = text('Health', '状態監視');
