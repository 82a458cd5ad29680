// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { dateText } from '../../lib/words';
import { appearancesOf, appearanceWords, lightWords } from './appearance_words';

const place = {
  id: 'p1',
  label: '',
  name: 'p1',
  prototype: 't1/a.jpg',
  members: ['t1/a.jpg'],
  features: 9,
  x: 0,
  y: 0,
};

describe('the looks that a place is recognised by', () => {
  it('are its own picture and what it learnt', () => {
    expect(appearancesOf(place)).toEqual([]);
    expect(appearancesOf({ ...place, brightness: 0.4 })).toEqual([{ image: 't1/a.jpg', brightness: 0.4 }]);
    const learnt = [{ image: null, brightness: 0.05 }];
    expect(appearancesOf({ ...place, brightness: 0.4, learnt })).toEqual([
      { image: 't1/a.jpg', brightness: 0.4 },
      { image: null, brightness: 0.05 },
    ]);
  });

  it('say from where they are, of when, and in which light', () => {
    const tours = [{ id: 't1', name: 'Ground floor', created_us: 1.7e15 }];
    expect(appearanceWords({ image: 't1/a.jpg', brightness: 0.4 }, tours)).toBe(
      `From the tour Ground floor, brought ${dateText(1.7e15)}, in good light`,
    );
    expect(appearanceWords({ image: 't9/a.jpg', brightness: 0.15 }, tours)).toBe(
      'A picture of a tour, in dim light',
    );
    expect(appearanceWords({ image: null, brightness: 0 }, tours)).toBe('Seen on a drive, in the dark');
    expect(lightWords(1)).toBe('in good light');
  });
});
