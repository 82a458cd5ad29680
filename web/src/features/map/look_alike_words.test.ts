// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { Graph, Hypothesis } from '../../api/types';
import { openBecause, openPairs } from './look_alike_words';

const masses = { true: 0.5, false: 0.1, unknown: 0.4 };
const pair = (a: string, b: string, part: Partial<Hypothesis> = {}): Hypothesis => ({
  prototype_a: `t/${a}.jpg`,
  prototype_b: `t/${b}.jpg`,
  masses_before: masses,
  masses_after: masses,
  support: 0.5,
  plausibility: 0.9,
  decision: 'undecided',
  by: 'method',
  ...part,
});
/** Places a to f in a row. */
const graph = (...hypotheses: Hypothesis[]): Graph => {
  const ids = ['a', 'b', 'c', 'd', 'e', 'f'];
  return {
    format: 'homeward-graph',
    version: 1,
    map: 'm',
    revision: 1,
    places: ids.map((id) => ({
      id,
      label: '',
      prototype: `t/${id}.jpg`,
      members: [`t/${id}.jpg`, `t/${id}2.jpg`],
      features: 1,
      x: 0,
      y: 0,
    })),
    edges: ids.slice(1).map((to, i) => ({
      from: ids[i] ?? '',
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
    })),
    destinations: [],
    hypotheses,
    shortcuts: [],
  };
};
const shown = (...hypotheses: Hypothesis[]) =>
  openPairs(graph(...hypotheses)).map((one) => `${one.prototype_a.charAt(2)}${one.prototype_b.charAt(2)}`);

describe('openPairs', () => {
  it('asks nobody about places beside each other, however alike they look', () => {
    const alike = { support: 1, plausibility: 1 };
    expect(shown(pair('a', 'b', alike), pair('c', 'a', alike), pair('a', 'd', alike))).toEqual(['ad']);
    expect(shown(pair('a', 'a2', alike))).toEqual([]);
  });

  it('asks nobody about what was decided, or is no more in the map', () => {
    expect(
      shown(
        pair('a', 'e', { decision: 'accepted' }),
        pair('a', 'f', { decision: 'rejected' }),
        pair('a', 'd', { by: 'person' }),
        pair('a', 'x'),
      ),
    ).toEqual([]);
  });

  it('has the likeliest first', () => {
    expect(shown(pair('a', 'd', { support: 0.2 }), pair('b', 'f', { support: 0.7 }))).toEqual(['bf', 'ad']);
  });
});

it('says why it was left open, and never that what is certain is undecided', () => {
  expect(openBecause(pair('a', 'd'))).toBe(
    'Between 50 % and 90 % sure that they are one place: too little to decide.',
  );
  expect(openBecause(pair('a', 'd', { support: 1, plausibility: 1 }))).not.toContain('100 %');
});
