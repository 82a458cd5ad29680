// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { Mission, Robot } from '../../api/types';
import { questionOf, questionWords, waitWords } from './question';

const mission: Mission = {
  format: 'homeward-mission',
  version: 2,
  id: 'one',
  robot: 'r',
  kind: 'drive',
  exploration: null,
  map: 'm',
  revision: 1,
  destination: 'hall',
  place: 'p5',
  state: 'driving',
  reason: null,
  epoch: 1,
  seq: 1,
  path: ['p1', 'p5'],
  path_index: 1,
  arrival_probability: 0.8,
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
  question: { number: 2, place: 'p5', label: 'south_hall', left_s: 41.5 },
  lease: null,
  status_age_ms: 0,
};

describe('questionOf', () => {
  it('is what the robot asks on its mission', () => {
    expect(questionOf(robot)).toEqual({ mission: 'one', number: 2, label: 'south_hall', left_s: 41.5 });
  });

  it('is nothing where nobody could answer', () => {
    expect(questionOf({ ...robot, question: null })).toBeNull();
    const { question, ...older } = robot; // of a server that knows no questions
    expect(question).toBeTruthy();
    expect(questionOf(older)).toBeNull();
    expect(questionOf({ ...robot, online: false })).toBeNull();
    expect(questionOf({ ...robot, mission: null })).toBeNull();
    for (const state of ['arrived', 'stopped', 'failed', 'refused'] as const)
      expect(questionOf({ ...robot, mission: { ...mission, state } })).toBeNull();
  });
});

describe('the words of a question', () => {
  const question = { mission: 'one', number: 2, label: 'south_hall', left_s: 41.5 };

  it('ask by the name of the destination', () => {
    expect(questionWords(question)).toBe('Is this the south hall?');
    expect(questionWords({ ...question, label: "Anna's room" })).toBe("Is this Anna's room?");
    expect(questionWords({ ...question, label: '' })).toBe('Is this the place that you chose?');
  });

  it('say how long it waits, less what has gone since', () => {
    expect(waitWords(question, 0)).toBe('I stand here and wait for an answer, 42 s more.');
    expect(waitWords(question, 1500)).toBe('I stand here and wait for an answer, 40 s more.');
    expect(waitWords(question, 41_000)).toBe('I give up waiting in a moment.');
    expect(waitWords(question, 90_000)).toBe('I give up waiting in a moment.');
  });
});
