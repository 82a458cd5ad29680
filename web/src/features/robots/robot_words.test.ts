// SPDX-License-Identifier: Apache-2.0
import { expect, it } from 'vitest';
import type { Robot } from '../../api/types';
import { directionWord, stateTone, stateWord, whyStopped } from './robot_words';

const robot: Robot = {
  id: 'r',
  name: 'Chair',
  online: true,
  map: null,
  state: 'stopped',
  reason: { code: 'way_blocked', parameters: {} },
  belief: null,
  mission: null,
  lease: null,
  status_age_ms: 5,
};

it('explains a stop, and says nothing of old reasons while driving', () => {
  expect(whyStopped(robot)).toBe('The way is blocked.');
  expect(whyStopped({ ...robot, state: 'driving' })).toBeNull();
  expect(whyStopped({ ...robot, reason: null })).toBeNull();
});

it('never calls a robot that is not connected by its last state', () => {
  expect(stateWord({ ...robot, online: false, state: 'driving' })).toBe('Not connected');
  expect(stateTone({ ...robot, online: false, state: 'driving' })).toBe('bad');
  expect(stateWord({ ...robot, state: null })).toBe('Connected');
});

it('names directions, left being positive', () => {
  expect(directionWord(0.1)).toBe('ahead');
  expect(directionWord(Math.PI / 2)).toBe('left');
  expect(directionWord(-Math.PI / 2)).toBe('right');
  expect(directionWord(Math.PI)).toBe('behind');
  expect(directionWord(-Math.PI)).toBe('behind');
});
