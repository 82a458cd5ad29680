// SPDX-License-Identifier: Apache-2.0
import { expect, it } from 'vitest';
import {
  corner,
  cornerText,
  fenceText,
  fencesOf,
  numberOf,
  sameFences,
  told,
  typedCorner,
} from './fence_words';

const square = fencesOf([
  [
    [1, 1],
    [3, 1],
    [3, 2.5],
    [1, 2.5],
  ],
]);

it('says how large a fence is, and where a corner', () => {
  expect(square.map(fenceText)).toEqual(['4 corners, 2.0 m by 1.5 m']);
  expect(cornerText([1.234, -0.5])).toBe('x 1.2 m, y −0.5 m');
});

it('takes fences for the same to the centimetre, and sends them as they are', () => {
  expect(sameFences(square, [square[0]?.map(([x, y]) => [x + 0.001, y] as const) ?? []])).toBe(true);
  expect(sameFences(square, [])).toBe(false);
  expect(told(square)[0]).toHaveLength(4);
  expect(corner([1.23456, -0.001])).toEqual([1.23, -0]);
});

it('reads numbers as people type them', () => {
  expect([' 1,5 ', '-2', '−2.25', '.5', '', 'x', '1e9', '1.2.3'].map(numberOf)).toEqual([
    1.5,
    -2,
    -2.25,
    0.5,
    null,
    undefined,
    undefined,
    undefined,
  ]);
  expect([typedCorner('1,257', '2'), typedCorner('1', ''), typedCorner('200000', '0')]).toEqual([
    [1.26, 2],
    null,
    null,
  ]);
});
