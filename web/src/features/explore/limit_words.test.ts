// SPDX-License-Identifier: Apache-2.0
import { expect, it } from 'vitest';
import { limitsOf } from './limit_words';

const typed = { minutes: '', metres: '', back: '' };

it('reads minutes and metres, and leaves out what is empty', () => {
  expect(limitsOf(typed)).toEqual({});
  expect(limitsOf({ minutes: '30', metres: '250,5', back: '12' })).toEqual({
    limit_s: 1800,
    limit_m: 250.5,
    back_after_s: 720,
  });
});

it('takes no limit that is no number, none or too large', () => {
  for (const wrong of ['soon', '0', '-3', '1000000'])
    expect([limitsOf({ ...typed, minutes: wrong }), limitsOf({ ...typed, metres: wrong })]).toEqual([
      null,
      null,
    ]);
});
