// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { Edge, Graph } from '../../api/types';
import { directionsOf, directionWords } from './way_words';

const edge = (part: Partial<Edge> = {}): Edge => ({
  from: 'p1',
  to: 'p2',
  bearing_rad: 0,
  turn_rad: 0,
  length_m: 1.24,
  length_from: 'odometry',
  confidence: 0.9,
  inliers: 40,
  weak: false,
  blocked: false,
  shortcut: false,
  by: 'method',
  ...part,
});

describe('a direction of a way', () => {
  it('says what the map knows of it', () => {
    expect(directionWords(edge())).toBe('1.2 m, 90 % sure where to head.');
    expect(directionWords(edge({ length_from: 'tour_images', weak: true, by: 'person' }))).toBe(
      'About 1.2 m, 90 % sure where to head, hard to drive, put there by a person.',
    );
    expect(directionWords(edge({ length_from: 'unknown' }))).toBe(
      'Length not known, 90 % sure where to head.',
    );
    expect(directionWords(null)).toBe('There is no way in this direction.');
  });

  it('is told from the other, as seen from a place', () => {
    const graph = { edges: [edge()] } as unknown as Graph;
    const [out, back] = directionsOf(graph, 'p2', 'p1');
    expect([out.from, out.edge, back.edge?.to]).toEqual(['p2', null, 'p2']);
  });
});
