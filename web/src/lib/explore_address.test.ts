// SPDX-License-Identifier: Apache-2.0
import { expect, it } from 'vitest';
import { explorePath, exploringRobot } from './explore_address';

it('leads to a robot and back', () => {
  expect(explorePath('r 1')).toBe('/robots/r%201/explore');
  expect(exploringRobot(explorePath('r 1'))).toBe('r 1');
});

it('is nothing but the address of that page', () => {
  for (const path of ['/robots', '/robots/r1', '/robots/r1/explore/more', '/tours/r1/explore'])
    expect(exploringRobot(path)).toBeNull();
  expect(exploringRobot('/robots/%/explore')).toBe('%');
});
