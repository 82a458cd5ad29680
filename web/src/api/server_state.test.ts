// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { applyEvent, statusAgeMs, type ServerState } from './server_state';
import type { Mission, Robot, ServerEvent } from './types';

const robot: Robot = {
  id: 'r1',
  name: 'Chair',
  online: true,
  map: 'm1',
  state: 'idle',
  belief: null,
  mission: null,
  lease: null,
  status_age_ms: 100,
};
const mission: Mission = {
  format: 'homeward-mission',
  version: 2,
  id: 'a',
  robot: 'r1',
  kind: 'drive',
  exploration: null,
  map: 'm1',
  revision: 1,
  destination: 'd1',
  place: 'p1',
  state: 'driving',
  reason: null,
  epoch: 1,
  seq: 1,
  path: ['p1'],
  path_index: 0,
  arrival_probability: null,
  created_us: 10,
  ended_us: null,
  by: 'anna',
};

function started(): ServerState {
  const state = applyEvent(
    null,
    { type: 'snapshot', v: 1, seq: 7, build: 'b', robots: [robot], jobs: [], maps: [] },
    1000,
  );
  if (state === 'gap') throw new Error('a snapshot is never a gap');
  return state;
}

describe('applyEvent', () => {
  it('replaces the robot that changed and remembers when', () => {
    const next = applyEvent(
      started(),
      { type: 'robot', v: 1, seq: 8, robot: { ...robot, state: 'driving' } },
      2000,
    );
    expect(next).toMatchObject({ seq: 8, robots: [{ id: 'r1', state: 'driving' }], heard_ms: { r1: 2000 } });
  });

  it('keeps the newest exploration of each robot until the next snapshot', () => {
    const told = (seq: number, id: string) =>
      ({ type: 'exploration', v: 1, seq, robot: 'r1', exploration: { id } }) as ServerEvent;
    const once = applyEvent(started(), told(8, 'x1'), 2000);
    const twice = once === 'gap' ? once : applyEvent(once, told(9, 'x2'), 3000);
    expect(twice).toMatchObject({ seq: 9, explorations: { r1: { id: 'x2' } } });
    expect(started().explorations).toEqual({});
  });

  it('adds a robot that it did not know', () => {
    const next = applyEvent(started(), { type: 'robot', v: 1, seq: 8, robot: { ...robot, id: 'r2' } }, 2000);
    expect(next === 'gap' ? [] : next.robots.map((one) => one.id)).toEqual(['r1', 'r2']);
  });

  it('takes numbers that were left out, passes over what the snapshot holds, and needs a snapshot first', () => {
    const changed: Robot = { ...robot, name: 'Walker' };
    expect(applyEvent(started(), { type: 'robot', v: 1, seq: 12, robot: changed }, 0)).toMatchObject({
      seq: 12,
      robots: [{ name: 'Walker' }],
    });
    const before = started();
    expect(applyEvent(before, { type: 'robot', v: 1, seq: 7, robot: changed }, 0)).toBe(before);
    expect(applyEvent(null, { type: 'robot', v: 1, seq: 1, robot }, 0)).toBe('gap');
  });

  it('gives a mission to its robot, but never an older one over a newer', () => {
    const driving = applyEvent(started(), { type: 'mission', v: 1, seq: 8, mission }, 0);
    if (driving === 'gap') throw new Error('no gap here');
    expect(driving.robots[0]?.mission?.id).toBe('a');
    const late = applyEvent(
      driving,
      { type: 'mission', v: 1, seq: 9, mission: { ...mission, id: 'z', created_us: 5 } },
      0,
    );
    if (late === 'gap') throw new Error('no gap here');
    expect(late.robots[0]?.mission?.id).toBe('a');
  });
});

describe('statusAgeMs', () => {
  it('adds the time since the event to the age that the server stated', () => {
    expect(statusAgeMs(robot, 1000, 3500)).toBe(2600);
    expect(statusAgeMs({ ...robot, status_age_ms: null }, 1000, 3500)).toBeNull();
  });
});
