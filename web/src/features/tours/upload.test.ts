// SPDX-License-Identifier: Apache-2.0
import { expect, it } from 'vitest';
import { arrived } from './upload';

it('goes on after what has arrived, and fills the gaps', () => {
  const tour = { images: 3, missing: [1] }; // 0, 2 and 3 are there
  expect([0, 1, 2, 3, 4].map((n) => arrived(tour, n))).toEqual([true, false, true, true, false]);
  expect(arrived({ images: 0, missing: [] }, 0)).toBe(false);
});

it('sends again where the list of what is missing may have been cut off', () => {
  const missing = Array.from({ length: 100 }, (_, i) => 2 * i);
  expect(arrived({ images: 500, missing }, 1)).toBe(true);
  expect(arrived({ images: 500, missing }, 199)).toBe(false);
});
