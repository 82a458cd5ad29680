// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { Edge, Graph, Place } from '../../api/types';
import { drawnEdges, matching, pictureShare, placeViews, probabilities, waysOut } from './place_views';

const place = (id: string, label: string, x: number): Place => ({
  id,
  label,
  prototype: `t/${id}.jpg`,
  members: [`t/${id}.jpg`],
  features: 1,
  x,
  y: 0.5,
});
const edge = (from: string, to: string, part: Partial<Edge> = {}): Edge => ({
  from,
  to,
  bearing_rad: null,
  turn_rad: null,
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
  revision: 3,
  places: [place('p1', '', 0), place('p2', 'kitchen', 0.5), place('p3', 'bath', 1)],
  edges: [
    edge('p1', 'p2'),
    edge('p2', 'p1', { blocked: true, length_m: 2 }),
    edge('p2', 'p3', { weak: true }),
  ],
  destinations: [],
  hypotheses: [],
  shortcuts: [],
};

describe('placeViews', () => {
  it('lists named places first, by name, with where the robot believes to be', () => {
    const belief = {
      updates: 3,
      place: 'p1',
      probability: 0.7,
      top: [{ place: 'p1', probability: 0.7 }],
      lost: false,
    };
    const views = placeViews(graph);
    expect(views.map((one) => one.title)).toEqual(['Bath', 'Kitchen', 'Near the kitchen']);
    expect([...probabilities(belief)]).toEqual([['p1', 0.7]]);
    expect(probabilities({ ...belief, lost: true }).size).toBe(0);
    expect(probabilities(null).size).toBe(0);
  });

  it('finds by words in any order', () => {
    const views = placeViews(graph);
    expect(matching(views, 'kitchen near').map((one) => one.id)).toEqual(['p1']);
    expect(matching(views, '')).toHaveLength(3);
    expect(matching(views, 'attic')).toEqual([]);
  });
});

describe('ways', () => {
  it('takes two directions as one way with the worse of both', () => {
    expect(waysOut(graph, 'p2')).toEqual([
      { other: 'p1', length_m: 2, weak: false, closed: 'one_way', shortcut: false },
      { other: 'p3', length_m: 1, weak: true, closed: 'no', shortcut: false },
    ]);
    expect(drawnEdges(graph).map((one) => [one.id, one.closed])).toEqual([
      ['p1|p2', 'one_way'],
      ['p2|p3', 'no'],
    ]);
  });

  it('calls a way closed only where no direction of it is left', () => {
    const closed = (...edges: Edge[]) => waysOut({ ...graph, edges }, 'p2').map((one) => one.closed);
    const there = edge('p1', 'p2', { blocked: true });
    const back = edge('p2', 'p1', { blocked: true });
    expect(closed(there, back)).toEqual(['both']);
    expect(closed(there)).toEqual(['both']);
    expect(closed(edge('p1', 'p2'), back)).toEqual(['one_way']);
    expect(closed(back, edge('p1', 'p2'))).toEqual(['one_way']);
    expect(closed(edge('p1', 'p2'), edge('p2', 'p1'))).toEqual(['no']);
  });
});

it('draws pictures smaller where places are close', () => {
  const close = { ...graph, places: Array.from({ length: 40 }, (_, i) => place(`p${i}`, '', i / 40)) };
  expect(pictureShare(placeViews(close))).toBeLessThan(pictureShare(placeViews(graph)));
  expect(pictureShare([])).toBeGreaterThan(0);
});
