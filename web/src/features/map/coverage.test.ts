// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { Edge, Graph } from '../../api/types';
import { coverageOf } from './coverage';

const place = (id: string, ...members: string[]) => ({
  id,
  label: '',
  prototype: members[0] ?? '',
  members,
  features: 1,
  x: 0,
  y: 0,
});
const way = (from: string, to: string, part: Partial<Edge> = {}): Edge => ({
  from,
  to,
  bearing_rad: 0,
  turn_rad: 0,
  length_m: 1,
  length_from: 'odometry',
  confidence: 0.9,
  inliers: 40,
  weak: false,
  blocked: false,
  shortcut: false,
  by: 'method',
  ...part,
});
const graph: Graph = {
  format: 'homeward-graph',
  version: 1,
  map: 'm',
  revision: 1,
  places: [
    place('p1', 't1/a', 't2/a'),
    place('p2', 't1/b'),
    place('p3', 't1/c', 't1/d'),
    place('p4', 't2/e'),
  ],
  edges: [
    way('p1', 'p2'),
    way('p2', 'p1'),
    way('p2', 'p3', { weak: true }),
    way('p3', 'p4', { blocked: true }),
  ],
  destinations: [],
  hypotheses: [],
  shortcuts: [],
};

describe('what the tours saw of the house', () => {
  it('is told by tour, and where one alone was', () => {
    const { tours, seen_once } = coverageOf(graph);
    expect(tours).toEqual([
      { tour: 't1', pictures: 4, places: 3 },
      { tour: 't2', pictures: 2, places: 2 },
    ]);
    expect(seen_once).toEqual(['p2', 'p3', 'p4']);
    const alone = { ...graph, places: [place('p1', 't1/a')] };
    expect(coverageOf(alone).seen_once).toEqual([]);
  });

  it('tells parts that are not joined, and ways that are hard to drive', () => {
    const { apart, weak } = coverageOf(graph);
    expect(apart).toEqual([['p4']]);
    expect(weak.map((one) => one.id)).toEqual(['p2|p3']);
  });
});
