// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { kPictograms, pictogramOf, pictogramWords, suggestedBy } from './pictograms';

describe('the pictogram of a destination', () => {
  it('is the one that a person gave it, else what its name suggests', () => {
    expect(pictogramOf('garden', 'Kitchen')).toBe('garden');
    expect(pictogramOf('', 'Kitchen')).toBe('kitchen');
    expect(pictogramOf('', 'Ben')).toBeNull();
  });

  it('is suggested by whole words, the more telling first', () => {
    const all = [
      'living_room',
      'Bathroom',
      'bed 4',
      'Guest toilet',
      'Front desk',
      'embedded',
      'Hallway',
      'Doctor',
    ];
    expect(all.map(suggestedBy)).toEqual([
      'seat',
      'bath',
      'bed',
      'toilet',
      'reception',
      null,
      'door',
      'treatment',
    ]);
  });

  it('has a word for each', () => {
    expect(kPictograms).toHaveLength(14);
    expect(new Set(kPictograms.map(pictogramWords)).size).toBe(14);
  });
});
