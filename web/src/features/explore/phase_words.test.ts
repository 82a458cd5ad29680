// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { Exploration, Mission, Robot } from '../../api/types';
import { durationText, figures, metresText, planWords, stageOf, stageWords, whyWords } from './phase_words';

const exploration: Exploration = {
  id: 'x1',
  phase: 'exploring',
  reason: null,
  pictures: 2,
  driven_m: 0.44,
  explored_s: 75,
  unreached: 1,
  pose: null,
  target: null,
  nodes: [],
  loops: [[1, 0]],
  floor: null,
  fences: [],
  uploaded: 0,
  tour: null,
  companion: null,
};
const mission = (state: Mission['state'], reason: Mission['reason'] = null) =>
  ({ kind: 'explore', exploration: 'x1', state, reason }) as Mission;
const robot = (now: Mission | null) => ({ id: 'r1', name: 'Chair', mission: now }) as Robot;
const stopped = { code: 'stopped_by', parameters: { by: 'anna' } };

describe('stageOf', () => {
  it('is what the robot tells', () => {
    expect(stageOf(robot(mission('driving')), exploration)).toBe('exploring');
    expect(stageOf(robot(mission('stopped')), { ...exploration, phase: 'paused' })).toBe('paused');
    expect(stageOf(robot(null), null)).toBe('none');
  });

  it('is about to begin until the robot tells of what it was sent to', () => {
    expect(stageOf(robot(mission('accepted')), null)).toBe('starting');
    expect(stageOf(robot(mission('accepted')), { ...exploration, phase: 'paused' })).toBe('starting');
    const other: Exploration = { ...exploration, id: 'x0', phase: 'uploaded' };
    expect(stageOf(robot(mission('accepted')), other)).toBe('starting');
  });
});

describe('words of an exploration', () => {
  it('name every phase', () => {
    expect(stageWords('exploring', 'Chair', exploration).title).toBe('Chair maps the building by itself');
    expect(stageWords('starting', 'Chair', null).title).toBe('Chair is about to set out');
    expect(stageWords('paused', 'Chair', exploration).tone).toBe('warn');
    const uploaded: Exploration = { ...exploration, phase: 'uploaded', tour: 't1' };
    expect(stageWords('uploaded', 'Chair', uploaded).title).toBe('Its pictures are a tour now');
  });

  it('speak of no tour where there is none', () => {
    const empty: Exploration = { ...exploration, phase: 'uploaded', pictures: 0, tour: null };
    expect(stageWords('uploaded', 'Chair', empty).title).toBe('It has ended, and no tour came of it');
    expect(planWords(empty, 'uploaded', 'Chair')).toMatch(/no tour came of it\. 0 pictures/);
  });

  it('say why, each reason once', () => {
    const paused: Exploration = { ...exploration, phase: 'paused', reason: stopped };
    expect(whyWords(robot(mission('stopped', stopped)), paused)).toEqual(['Stopped by anna.']);
    const moved = { code: 'robot_moved_since', parameters: {} };
    expect(whyWords(robot(mission('failed', moved)), paused)).toHaveLength(2);
    expect(whyWords(robot(mission('driving')), exploration)).toEqual([]);
    const over: Exploration = { ...exploration, phase: 'uploaded' };
    expect(whyWords(robot(mission('stopped', stopped)), over)).toEqual([]);
    const limit = { code: 'exploration_limit', parameters: {} };
    expect(whyWords(robot(null), { ...exploration, reason: limit })).toEqual([
      'The limit of way or time is reached.',
    ]);
  });

  it('count what there is', () => {
    expect(figures(exploration).map(([, value]) => value)).toEqual(['2', '0.4 m', '1 min', '1 place']);
    expect([durationText(59.9), durationText(3725)]).toEqual(['59 s', '1 h 2 min']);
    expect([metresText(99.94), metresText(1234.5)]).toEqual(['99.9 m', '1235 m']);
  });

  it('tell the plan to those who do not see it', () => {
    expect(planWords(exploration, 'exploring', 'Chair')).toMatch(
      /2 pictures, 0.4 m driven, 1 place known again, 0 fences\. Nothing of the floor/,
    );
    expect(planWords(null, 'none', 'Chair')).toMatch(/nothing was seen/);
  });
});
