// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { Graph, Job, Reason } from '../../api/types';
import { jumpsOf, noteWords, unnamedPlaces } from './notes';

const job = (...notes: Reason[]) => ({ notes }) as unknown as Job;
const place = (id: string, label: string) => ({
  id,
  label,
  prototype: `t/${id}.jpg`,
  members: [`t/${id}.jpg`],
  features: 1,
  x: 0,
  y: 0,
});
const edge = { from: 'p4', to: 'p5' } as Graph['edges'][number];
const graph = {
  places: [place('p4', ''), place('p5', 'kitchen')],
  edges: [edge],
  destinations: [],
} as unknown as Graph;
const gains: Reason = {
  code: 'place_would_gain',
  parameters: { place: { code: 'place_numbered', parameters: { place: 'p4' } }, appearances: 1 },
};
const jumps: Reason = {
  code: 'warning_at',
  parameters: {
    warning: {
      code: 'tour_jumps',
      parameters: {
        jumps: 1,
        steps: 9,
        pictures: [{ code: 'jump', parameters: { from: '0004.jpg', to: '0005.jpg' } }],
      },
    },
    image: 'lJwpQKCWBY87/0005.jpg',
  },
};

describe('noteWords', () => {
  it('calls places by their names or by what is near, never by their numbers', () => {
    expect(noteWords(job(gains), graph)).toBe('Near the kitchen would gain 1 new appearance.');
    expect(noteWords(job(gains), null)).toBe('A place would gain 1 new appearance.');
    expect(noteWords(job(gains), { ...graph, places: [place('p4', '')] })).toBe(
      'A place would gain 1 new appearance.',
    );
  });

  it('tells of pictures without the id of their tour', () => {
    const words = noteWords(job(jumps), graph);
    expect(words).toContain('0004.jpg to 0005.jpg');
    expect(words).toMatch(/ are they out of order\?$/);
    const older = { code: 'picture_older', parameters: {} };
    const at = { code: 'warning_at', parameters: { warning: older, image: 'lJwpQKCWBY87/0005.jpg' } };
    expect(noteWords(job(at), graph)).toMatch(/ \(0005.jpg\)$/);
  });
});

it('knows which pictures to show', () => {
  expect(unnamedPlaces(job(gains), graph)).toEqual(['p4']);
  expect(unnamedPlaces(job(gains), null)).toEqual([]);
  expect(unnamedPlaces(job(jumps), graph)).toEqual([]);
  expect(jumpsOf(job(gains, jumps))).toEqual([
    { from: 'lJwpQKCWBY87/0004.jpg', to: 'lJwpQKCWBY87/0005.jpg' },
  ]);
});
