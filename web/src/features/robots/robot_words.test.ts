// SPDX-License-Identifier: Apache-2.0
import { expect, it } from 'vitest';
import type { Mission, Robot } from '../../api/types';
import { directionWord, endOf, stateTone, stateWord, whyStopped } from './robot_words';

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

it('says when that was where the stop was that of its last drive', () => {
  const ended_us = new Date(2026, 4, 7, 12, 5).getTime() * 1000;
  const mission = { state: 'stopped', reason: robot.reason, ended_us } as Mission;
  expect(endOf({ ...robot, mission }, ended_us / 1000)).toMatch(/^That was at 12:05.*\.$/);
  expect(endOf({ ...robot, reason: null, mission }, ended_us / 1000)).toMatch(/12:05/);
  const other = { code: 'stopped_by', parameters: { by: 'vera' } };
  expect(endOf({ ...robot, reason: other, mission }, ended_us / 1000)).toBeNull();
  expect(endOf(robot, ended_us / 1000)).toBeNull();
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
