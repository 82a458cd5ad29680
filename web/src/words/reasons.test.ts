// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import english from '../../../proto/reasons.en.json';
import contract from '../../../proto/reasons.json';
import { catalogueFor, reasonSentence, reasonWords, type Catalogue } from './reasons';

const blocked = { code: 'way_blocked', parameters: {} };

function placeholders(template: string): string[] {
  return [...new Set([...template.matchAll(/\{([a-z_]+)/g)].map((match) => match[1] ?? ''))].sort();
}

describe('the English catalogue', () => {
  it('says something for each code, with the parameters that it has', () => {
    expect(Object.keys(english.reasons).sort()).toEqual(Object.keys(contract.codes).sort());
    const reasons: Readonly<Record<string, string>> = english.reasons;
    for (const [code, { parameters }] of Object.entries(contract.codes))
      for (const name of placeholders(reasons[code] ?? '')) expect(parameters, code).toHaveProperty(name);
  });
});

describe('reasonWords', () => {
  it('fills in names, counts and other reasons', () => {
    const by = { code: 'stopped_by', parameters: { by: 'Anna' } };
    expect(reasonWords(by, english)).toBe('Stopped by Anna.');
    const detour = { code: 'takes_another_way', parameters: { because: blocked } };
    expect(reasonWords(detour, english)).toBe('The way is blocked. I take another way.');
    const unnamed = { code: 'destination_unsure', parameters: { destination: '' } };
    expect(reasonWords(unnamed, english)).toBe('I am not sure that this is the destination.');
  });

  it('chooses the form of a word by its count', () => {
    const more = (places: number) =>
      reasonWords({ code: 'more_places_gained', parameters: { places } }, english);
    expect(more(1)).toBe('So did 1 more place.');
    expect(more(2)).toBe('So did 2 more places.');
  });

  it('joins lists, and series without an "and"', () => {
    const step = (from: string, to: string) => ({ code: 'jump', parameters: { from, to } });
    const jumps = {
      code: 'tour_jumps',
      parameters: { jumps: 2, steps: 9, pictures: [step('1', '2'), step('7', '8')] },
    };
    expect(reasonWords(jumps, english)).toContain(': 1 to 2, 7 to 8. These');
    const closed = (to: string) => ({ code: 'obstacle_closed', parameters: { from: 'p1', to } });
    const none = {
      code: 'no_way',
      parameters: { from: 'p1', to: 'p9', obstacles: [closed('p2'), closed('p3')] },
    };
    expect(reasonWords(none, english)).toContain('is closed and the way from p1 to p3');
  });

  it('says in English what a translation lacks, and knows the plurals of its language', () => {
    const polish: Catalogue = {
      language: 'pl',
      words: { between: ', ', last: ' i ', destination: 'cel' },
      reasons: { more_places_gained: '{places} {places?miejsce:miejsca:miejsc:miejsca}' },
    };
    expect(reasonWords(blocked, polish)).toBe('The way is blocked.');
    const more = (places: number) =>
      reasonWords({ code: 'more_places_gained', parameters: { places } }, polish);
    expect([more(1), more(3), more(5)]).toEqual(['1 miejsce', '3 miejsca', '5 miejsc']);
  });

  it('shows the code that no catalogue has', () => {
    expect(reasonWords({ code: 'of_tomorrow', parameters: {} }, english)).toBe('of tomorrow');
  });
});

it('falls back to English, and makes sentences of what people wrote', () => {
  expect(catalogueFor(['xx-YY', 'en-GB']).language).toBe('en');
  expect(catalogueFor([]).language).toBe('en');
  expect(reasonSentence({ code: 'text', parameters: { text: 'a cat' } })).toBe('A cat.');
});
