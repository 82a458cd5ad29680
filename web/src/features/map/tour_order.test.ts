// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { byTour, fileOf } from './tour_order';

describe('byTour', () => {
  it('keeps the pictures of a tour together, in the order in which they were taken', () => {
    expect(byTour(['t2/a10.jpg', 't10/b.jpg', 't2/a9.jpg'])).toEqual([
      { tour: 't2', images: ['t2/a9.jpg', 't2/a10.jpg'] },
      { tour: 't10', images: ['t10/b.jpg'] },
    ]);
    expect(byTour([])).toEqual([]);
    expect(fileOf('t2/a9.jpg')).toBe('a9.jpg');
  });
});
