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
  it('are not asked for where each place has one', () => {
    expect(spotsFor(cytoscape, [graphOf(place('p1', 0), place('p2', 1))], 100)).toBeNull();
  });

  it('keep places apart, those of an earlier state too', () => {
    const states = [graphOf(place('p1', null), place('p2', null)), graphOf(place('p3', 0.5))];
    const spots = [...(spotsFor(cytoscape, states, 100)?.values() ?? [])];
    expect(spots).toHaveLength(3);
    for (const [i, a] of spots.entries())
      for (const b of spots.slice(i + 1)) expect(Math.hypot(a.x - b.x, a.y - b.y)).toBeGreaterThan(100);
  });
});
