// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { Graph, ReplayCheck, WorseSpot } from '../../api/types';
import { verdictWords, worseWords } from './check_words';

const place = (id: string, label: string, name = '') => ({
  id,
  label,
  name,
  prototype: `t/${id}.jpg`,
  members: [`t/${id}.jpg`],
  features: 1,
  x: 0,
  y: 0,
});
const graph: Graph = {
  format: 'homeward-graph',
  version: 1,
  map: 'm',
  revision: 3,
  places: [place('p1', 'hall'), place('p2', 'bathroom'), place('p3', '', 'second from the hall')],
  edges: [],
  destinations: [],
  hypotheses: [],
  shortcuts: [],
};
const without = { ...graph, places: graph.places.slice(1) };
const said = (spot: Partial<WorseSpot>) =>
  worseWords(
    {
      kind: 'localisation',
      place: 'p1',
      other: null,
      images: ['t/1', 't/2', 't/3'],
      of: 14,
      times: 3,
      distance_m: 6.14,
      words: '',
      ...spot,
    },
    graph,
    without,
  );

describe('what a check found', () => {
  it('is a sentence for each kind', () => {
    expect(said({})).toBe('In the hall the chair would be lost on 3 of 14 pictures.');
    expect(said({ place: 'p3', other: 'p2', of: 3 })).toBe(
      'At “Second from the hall” the chair would be lost on all 3 pictures. Most of them would be taken for Bathroom.',
    );
    expect(said({ kind: 'pictures' })).toBe('Of what came to Hall, 3 of 14 pictures do not show it.');
    expect(said({ kind: 'places' })).toBe(
      'Of what came to Hall, 3 of 14 pictures were taken 6.1 m away from it.',
    );
    expect(said({ kind: 'way', other: 'p2' })).toBe('No picture sees the new way from Hall to Bathroom.');
    expect(said({ kind: 'far_way', other: 'p2' })).toBe(
      'The new way from Hall to Bathroom is about 6.1 m: too long to be seen along.',
    );
    expect(said({ kind: 'route', other: 'p2' })).toBe(
      'The chair could not drive from Hall to Bathroom any more.',
    );
    expect(said({ kind: 'drives', images: ['t/p1.jpg'], other: 'p2' })).toBe(
      'On its drives the chair would not have known Hall on 3 of 14 pictures. Most of it would be taken for Bathroom.',
    );
    expect(said({ kind: 'destination' })).toBe('The destination at Hall would go with its place.');
  });

  it('has a verdict', () => {
    const check = { harmless: true, pictures: 300, worse: [] } as unknown as ReplayCheck;
    expect(verdictWords(check)).toBe('Nothing gets worse on the 300 pictures of the tours.');
    expect(verdictWords({ ...check, harmless: false, worse: [{} as WorseSpot] })).toMatch(
      /^One thing gets worse/,
    );
  });
});
