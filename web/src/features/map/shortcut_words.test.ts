// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { Graph, Shortcut } from '../../api/types';
import { evidenceOf, proposedLines, shortcutsAt, shortcutsToShow } from './shortcut_words';

function shortcut(place_a: string, place_b: string, change: Partial<Shortcut> = {}): Shortcut {
  return {
    image_a: `t/${place_a}`,
    image_b: `t/${place_b}`,
    place_a,
    place_b,
    bearing_rad: 0.1,
    turn_rad: 0.2,
    length_m: 2.5,
    way_m: 9.75,
    clear_m: 1.24,
    confidence: 0.92,
    inliers: 64,
    state: 'proposed',
    by: 'method',
    ...change,
  };
}

function graphOf(shortcuts: Shortcut[]): Graph {
  const place = (id: string) => ({
    id,
    label: '',
    prototype: `t/${id}`,
    members: [`t/${id}`],
    features: 1,
    x: 0,
    y: 0,
  });
  return {
    format: 'homeward-graph',
    version: 1,
    map: 'm1',
    revision: 1,
    places: ['p1', 'p2', 'p3'].map(place),
    edges: [],
    destinations: [],
    hypotheses: [],
    shortcuts,
  };
}

describe('shortcuts', () => {
  it('come in the order in which a person decides on them', () => {
    const graph = graphOf([
      shortcut('p1', 'p2', { state: 'rejected' }),
      shortcut('p1', 'p3'),
      shortcut('p2', 'p3', { way_m: 20 }),
    ]);
    expect(shortcutsToShow(graph).map((one) => one.place_b + one.state)).toEqual([
      'p3proposed',
      'p3proposed',
      'p2rejected',
    ]);
    expect(shortcutsToShow(graph)[0]?.way_m).toBe(20);
    expect(shortcutsAt(graph, 'p2')).toHaveLength(2);
  });

  it('say what speaks for them', () => {
    expect(evidenceOf(shortcut('p1', 'p2'))).toBe(
      '2.5 m straight instead of 9.8 m by the way that was driven. ' +
        'On the tour 1.2 m of floor were seen free all along. ' +
        'The two pictures have 64 things in common and tell the direction that the tour tells; ' +
        'by themselves they would be 92 % sure of it.',
    );
  });

  it('are drawn while they wait, between places that are there', () => {
    const graph = graphOf([
      shortcut('p1', 'p2'),
      shortcut('p1', 'p3', { state: 'accepted' }),
      shortcut('p1', ''),
    ]);
    expect(proposedLines(graph)).toEqual([{ id: 'shortcut:p1|p2', from: 'p1', to: 'p2' }]);
  });
});
