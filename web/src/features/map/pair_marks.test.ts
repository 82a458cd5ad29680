// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { pairMarks, pairWords } from './pair_marks';

const match = (x: number, x_b: number, distinctiveness: number, agrees = true) => ({
  a: { x, y: 0.5 },
  b: { x: x_b, y: 0.5 },
  distinctiveness,
  agrees,
});

describe('what is in both pictures', () => {
  it('is drawn where the second picture is moved to, the rarest first', () => {
    const marks = pairMarks({
      shift: 0.1,
      matches: [match(0.2, 0.3, 0.1), match(0.95, 0.05, 0.9), match(0, 0, 1, false)],
    });
    expect(marks.map((one) => [one.number, one.rarity, one.b.x.toFixed(2)])).toEqual([
      [1, 'rare', '0.95'],
      [2, 'common', '0.20'],
    ]);
  });

  it('is not joined around the edge of a panorama', () => {
    expect(pairMarks({ shift: null, matches: [match(0.95, 0.05, 0.9)] })[0]?.number).toBeNull();
  });

  it('is said in words', () => {
    expect(pairWords({ matches: [match(0, 0, 0.9), match(0, 0, 0.5), match(0, 0, 1, false)] })).toBe(
      '3 things are in both pictures; 2 of them lie as they would for one and the same place, 1 of these are rare in the house.',
    );
    expect(pairWords({ matches: [] })).toBe('Nothing was found that is in both pictures.');
  });
});
