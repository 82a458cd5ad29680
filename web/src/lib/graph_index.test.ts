// SPDX-License-Identifier: Apache-2.0
import { expect, it } from 'vitest';
import type { Edge, Graph, Place } from '../api/types';
import { indexOf } from './graph_index';
import { placeTitle } from './whereabouts';

const place = (n: number, label: string): Place => ({
  id: `p${n}`,
  label,
  prototype: `t/${n}.jpg`,
  members: [`t/${n}.jpg`],
  features: 1,
  x: n,
  y: 0,
});
const edge = (from: number, to: number): Edge => ({
  from: `p${from}`,
  to: `p${to}`,
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
});

/** A corridor of so many places, with a name for the first and the last. */
function corridor(places: number): Graph {
  const numbers = Array.from({ length: places }, (_, n) => n);
  const names = new Map([
    [0, 'porch'],
    [places - 1, 'kitchen'],
  ]);
  return {
    format: 'homeward-graph',
    version: 1,
    map: 'm',
    revision: 1,
    places: numbers.map((n) => place(n, names.get(n) ?? '')),
    edges: numbers.slice(1).map((n) => edge(n - 1, n)),
    destinations: [],
    hypotheses: [],
    shortcuts: [],
  };
}

it('knows each place, its neighbours and the nearest that has a name, also of thousands', () => {
  const graph = corridor(5000);
  const index = indexOf(graph);
  expect(index.places.size).toBe(5000);
  expect([index.names.size, index.nearest_names.size]).toEqual([2, 4998]);
  expect(index.neighbours.get('p1')).toEqual(['p0', 'p2']);
  expect(index.place_of_image.get('t/7.jpg')?.id).toBe('p7');
  expect(['p0', 'p2499', 'p2500'].map((id) => placeTitle(graph, id))).toEqual([
    'Porch',
    'Near the porch',
    'Near the kitchen',
  ]);
});

it('says nothing is near where no way leads', () => {
  const graph = { ...corridor(4), edges: [edge(0, 1)] };
  expect(placeTitle(graph, 'p1')).toBe('Near the porch');
  expect(placeTitle(graph, 'p2')).toBe('p2');
});

it('is made once for a graph, and anew for the next', () => {
  const graph = corridor(4);
  expect(indexOf(graph)).toBe(indexOf(graph));
  const renamed = { ...graph, places: graph.places.map((one) => ({ ...one, label: 'attic' })) };
  expect(placeTitle(renamed, 'p2')).toBe('Attic');
  expect(placeTitle(graph, 'p2')).toBe('Near the kitchen');
});
