// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { Mission, Robot } from '../../api/types';
import { hindrance, journeyOf, placesToGo, progressOf, wishOf } from './journey';

const mission: Mission = {
  format: 'homeward-mission',
  version: 2,
  id: 'one',
  robot: 'r',
  kind: 'drive',
  exploration: null,
  map: 'm',
  revision: 1,
  destination: 'kitchen',
  place: 'p5',
  state: 'driving',
  reason: null,
  epoch: 1,
  seq: 1,
  path: ['p1', 'p2', 'p3', 'p4', 'p5'],
  path_index: 2,
  arrival_probability: null,
  created_us: 100,
  ended_us: null,
  by: 'anna',
};
const robot: Robot = {
  id: 'r',
  name: 'Chair',
  online: true,
  map: 'm',
  state: 'driving',
  belief: null,
  mission,
  lease: null,
  status_age_ms: 0,
};
const exploring: Mission = {
  ...mission,
  kind: 'explore',
  exploration: 'x1',
  map: null,
  destination: null,
  place: null,
  path: [],
};
const target = { destination: 'bedroom', label: 'Bedroom' };

describe('journeyOf', () => {
  it('shows a new command before anything else', () => {
    expect(journeyOf(robot, { kind: 'asking', target })).toMatchObject({
      phase: 'asking',
      destination: 'bedroom',
    });
    expect(journeyOf(robot, { kind: 'refused', target, reason: 'No route.' })).toMatchObject({
      phase: 'refused',
      refusal: 'No route.',
    });
  });

  it('shows the sent mission until the robot tells of it, then what the robot tells', () => {
    const sent = {
      ...mission,
      id: 'two',
      destination: 'bedroom',
      state: 'accepted' as const,
      created_us: 200,
    };
    expect(journeyOf(robot, { kind: 'sent', target, mission: sent })).toMatchObject({ phase: 'accepted' });
    const reported = { ...robot, mission: { ...sent, state: 'arrived' as const } };
    expect(journeyOf(reported, { kind: 'sent', target, mission: sent })).toMatchObject({ phase: 'arrived' });
  });

  it('shows what somebody else asked for later', () => {
    const later = { ...robot, mission: { ...mission, id: 'three', created_us: 300 } };
    expect(journeyOf(later, { kind: 'sent', target, mission })?.destination).toBe('kitchen');
  });

  it('has nothing to show for a robot that was never sent anywhere', () => {
    expect(journeyOf({ ...robot, mission: null }, undefined)).toBeNull();
  });
});

describe('wishOf', () => {
  it('is another way for a robot that is under way, and nothing new where it goes there already', () => {
    const under_way = journeyOf(robot, undefined);
    expect(wishOf(under_way, target)).toBe('diversion');
    expect(wishOf(under_way, { destination: 'kitchen', label: 'Kitchen' })).toBe('same');
    expect(wishOf(under_way, { place: 'p5', label: 'p5' })).toBe('diversion');
    expect(wishOf(journeyOf(robot, { kind: 'asking', target }), target)).toBe('same');
  });

  it('is a new drive for one that stands', () => {
    expect(wishOf(null, target)).toBe('new');
    for (const state of ['arrived', 'stopped', 'failed', 'refused'] as const)
      expect(wishOf(journeyOf({ ...robot, mission: { ...mission, state } }, undefined), target)).toBe('new');
  });
});

describe('progressOf', () => {
  it('goes from 0 to 1 and bears odd paths', () => {
    const journey = journeyOf(robot, undefined);
    expect(journey && [placesToGo(journey), progressOf(journey)]).toEqual([3, 0.25]);
    const started = journeyOf({ ...robot, mission: { ...mission, path_index: 0 } }, undefined);
    expect(started && [placesToGo(started), progressOf(started)]).toEqual([4, 0]);
    const odd = journeyOf({ ...robot, mission: { ...mission, path: ['p5'], path_index: 7 } }, undefined);
    expect(odd && progressOf(odd)).toBe(0);
    const there = journeyOf({ ...robot, mission: { ...mission, state: 'arrived' } }, undefined);
    expect(there && progressOf(there)).toBe(1);
  });
});

describe('hindrance', () => {
  it('names the first thing that keeps the robot from being sent', () => {
    expect(hindrance(robot, true, true)).toBeNull();
    expect(hindrance(robot, true, false)).toContain('account');
    expect(hindrance(robot, false, true)).toContain('server');
    expect(hindrance({ ...robot, online: false }, true, true)).toContain('not connected');
    expect(hindrance({ ...robot, map: null }, true, true)).toContain('map');
  });
});

describe('a robot that maps the building by itself', () => {
  it('is under way to nowhere, and is not sent anywhere meanwhile', () => {
    const away = { ...robot, mission: exploring };
    const journey = journeyOf(away, undefined);
    expect(journey).toMatchObject({ explores: true, phase: 'driving', place: null });
    expect(wishOf(journey, target)).toBe('diversion');
    expect(hindrance(away, true, true)).toBe(
      'Chair maps the building by itself. Stop it before you send it.',
    );
    expect(hindrance({ ...away, mission: { ...exploring, state: 'stopped' } }, true, true)).toBeNull();
  });
});
