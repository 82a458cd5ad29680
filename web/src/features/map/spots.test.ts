// SPDX-License-Identifier: Apache-2.0
import cytoscape from 'cytoscape';
import { describe, expect, it } from 'vitest';
import type { Graph } from '../../api/types';
import { spotsFor } from './spots';

const place = (id: string, x: number | null) => ({
  id,
  label: '',
  prototype: `t/${id}.jpg`,
  members: [`t/${id}.jpg`],
  features: 1,
  x,
  y: x,
});
const graphOf = (...places: Graph['places']): Graph => ({
  format: 'homeward-graph',
  version: 1,
  map: 'm',
  revision: 3,
  places,
  edges: [],
  destinations: [],
  hypotheses: [],
  shortcuts: [],
});

describe('spots of places that a map gives none', () => {
  it('are asked for by no place that has one', () => {
    expect(spotsFor(cytoscape, graphOf(place('p1', 0), place('p2', 1))).size).toBe(0);
  });

  it('lie apart', () => {
    const spots = spotsFor(cytoscape, graphOf(place('p1', null), place('p2', null)));
    const [a, b] = [spots.get('p1'), spots.get('p2')];
    expect(a && b && Math.hypot(a.x - b.x, a.y - b.y)).toBeGreaterThan(1);
  });
});
