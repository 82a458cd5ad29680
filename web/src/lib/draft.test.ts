// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { onto, without } from './draft';

it('empties a field that was sent, but not what was typed meanwhile', () => {
  expect(without('Upstairs')('Upstairs')).toBe('');
  expect(without('Upstairs')('Garden')).toBe('Garden');
});

describe('onto', () => {
  it('follows what is saved while nothing is typed', () => {
    expect(onto({ text: 'hall', base: 'hall' }, 'porch')).toEqual({ text: 'porch', base: 'porch' });
  });

  it('never takes away what was typed', () => {
    const typed = { text: 'Coat st', base: 'hall' };
    expect(onto(typed, 'porch')).toBe(typed);
    expect(onto(typed, '')).toBe(typed);
    const longer = { text: 'hall ', base: 'hall' };
    expect(onto(longer, 'hall')).toBe(longer);
  });

  it('is done when what was typed is saved', () => {
    expect(onto({ text: ' Coat stand', base: 'hall' }, 'Coat stand')).toEqual({
      text: 'Coat stand',
      base: 'Coat stand',
    });
  });
});
