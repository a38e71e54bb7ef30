import { in_both } from '../i18n/i18n';

// Only what the page needs before the panel is fetched; all else is in words.ts.
export const texts = in_both({
  title: ['Scenario', 'シナリオ'],
});
