// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { Draft, Graph } from '../../api/types';
import { draftsAt, draftTitle, overlapsWith, touchedWords } from './draft_words';

const draft = (id: string, touches: string[], part: Partial<Draft> = {}): Draft => ({
  id,
  map: 'm1',
  name: '',
  by: 'anna',
  created_us: 0,
  version: 1,
  revision: 1,
  changes: 0,
  edits: [],
  touches,
  overlaps: [],
  check: null,
  ...part,
});
const place = (id: string, label: string) => ({
  id,
  label,
  prototype: `t/${id}.jpg`,
  members: [`t/${id}.jpg`],
  features: 1,
  x: 0,
  y: 0,
});
const graph: Graph = {
  format: 'homeward-graph',
  version: 1,
  map: 'm1',
  revision: 1,
  places: ['hall', 'kitchen', 'porch', 'bath', 'study'].map((label, i) => place(`p${i}`, label)),
  edges: [],
  destinations: [],
  hypotheses: [],
  shortcuts: [],
};

describe('drafts in words', () => {
  it('have a title', () => {
    expect(draftTitle(draft('d1', []))).toBe('Draft of anna');
    expect(draftTitle(draft('d1', [], { name: 'Night ward' }))).toBe('Night ward');
  });

  it('name the places that they change, a few of many', () => {
    expect(touchedWords(['p0'], graph)).toBe('Hall');
    expect(touchedWords(['p0', 'p1', 'p9'], graph)).toBe('Hall and Kitchen');
    expect(touchedWords(['p0', 'p1', 'p2', 'p3', 'p4'], graph)).toBe(
      'Hall, Kitchen, Porch and 2 more places',
    );
    expect(touchedWords([], graph)).toBe('');
  });

  it('tell which others change the same places', () => {
    const mine = draft('d1', ['p0', 'p1']);
    const all = [mine, draft('d2', ['p1', 'p4'], { by: 'ben' }), draft('d3', ['p3'])];
    expect(overlapsWith(mine, all).map(({ draft: one, places }) => [one.id, places])).toEqual([
      ['d2', ['p1']],
    ]);
    expect(draftsAt('p1', all, mine).map((one) => one.id)).toEqual(['d2']);
    expect(draftsAt('p1', all, null).map((one) => one.id)).toEqual(['d1', 'd2']);
  });
});
