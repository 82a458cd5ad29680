// SPDX-License-Identifier: Apache-2.0
import { expect, it } from 'vitest';
import { tokenIn } from './setup_token';

it('finds the token wherever the link carries it', () => {
  expect(tokenIn('#abc-1', '')).toBe('abc-1');
  expect(tokenIn('#token=abc', '')).toBe('abc');
  expect(tokenIn('', '?token=a%2Bb')).toBe('a+b');
  expect(tokenIn('', '')).toBe('');
});
