// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { Journey } from './journey';
import { heading, reasonOf } from './journey_words';

const journey: Journey = {
  id: 'one',
  phase: 'arrived',
  destination: 'kitchen',
  place: 'p5',
  reason: null,
  by: 'anna',
  path: ['p1', 'p5'],
  path_index: 1,
};

describe('what a journey says', () => {
  it('says where it ended', () => {
    expect(heading(journey, null)).toBe('Arrived: the place you chose');
    expect(reasonOf(journey)).toBeNull();
  });

  it('says what was not right where it arrived', () => {
    const beside = { ...journey, reason: 'I am there, but cannot turn to the right heading.' };
    expect(reasonOf(beside)).toBe('I am there, but cannot turn to the right heading.');
  });
});
