// SPDX-License-Identifier: Apache-2.0
import { expect, it } from 'vitest';
import type { Job } from '../../api/types';
import { newestJob, stageWords } from './jobs';

const job = (id: string, created_us: number, part: Partial<Job> = {}): Job => ({
  id,
  kind: 'build',
  map: 'm',
  state: 'running',
  progress: { stage: 'compare', share: 0.5 },
  error: null,
  skipped: 0,
  gained: 0,
  notes: [],
  created_us,
  ...part,
});

it('takes the newest job of the map, wherever it stands in the list', () => {
  const jobs = [job('a', 5), job('b', 9), job('c', 7), job('d', 99, { map: 'other' })];
  expect(newestJob(jobs, 'm')?.id).toBe('b');
  expect(newestJob(jobs, 'none')).toBeNull();
  expect(newestJob([...jobs, job('e', 100, { kind: 'refine' })], 'm')?.id).toBe('b');
  expect(newestJob([...jobs, job('e', 100, { kind: 'refine' })], 'm', ['refine'])?.id).toBe('e');
});

it('tells stages in words, and unknown ones by their name', () => {
  expect(stageWords(job('a', 1))).toBe('Comparing the pictures');
  expect(stageWords(job('a', 1, { state: 'queued' }))).toBe('Waiting for its turn');
  expect(stageWords(job('a', 1, { progress: { stage: 'new stage', share: 0 } }))).toBe('New stage');
});
