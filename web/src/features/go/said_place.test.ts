// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { Graph, Mission, Robot } from '../../api/types';
import { askWords, mayBeSaid, needsWord, offerWords, spotsOf, thanksWords } from './said_place';

const place = (id: string, label: string) => ({
  id,
  label,
  prototype: `t/${id}.jpg`,
  members: [],
  features: 0,
  x: 0,
  y: 0,
});
const graph: Graph = {
  format: 'homeward-graph',
  version: 1,
  map: 'm',
  revision: 1,
  places: [place('p1', 'living_room'), place('p2', ''), place('p3', 'hall'), place('p4', 'hall')],
  edges: [],
  destinations: [
    { id: 'd1', place: 'p1', image: 't/sofa.jpg', label: 'living_room', pictogram: '' },
    { id: 'd2', place: 'p2', image: 't/x.jpg', label: ' ', pictogram: '' },
  ],
  hypotheses: [],
  shortcuts: [],
};
const mission: Mission = {
  format: 'homeward-mission',
  version: 2,
  id: 'one',
  robot: 'r',
  kind: 'drive',
  exploration: null,
  map: 'm',
  revision: 1,
  destination: null,
  place: 'p1',
  state: 'arrived',
  reason: null,
  epoch: 1,
  seq: 1,
  path: ['p1'],
  path_index: 0,
  arrival_probability: null,
  created_us: 100,
  ended_us: null,
  by: 'anna',
};
const robot: Robot = {
  id: 'r',
  name: 'Chair',
  online: true,
  map: 'm',
  state: 'idle',
  belief: null,
  mission: null,
  lease: null,
  status_age_ms: 0,
};

describe('spotsOf', () => {
  it('gives every name once, with the picture of the destination before that of a place', () => {
    expect(spotsOf(graph)).toEqual([
      { label: 'living_room', name: 'Living room', place: 'p1', image: 't/sofa.jpg' },
      { label: 'hall', name: 'Hall', place: 'p3', image: 't/p3.jpg' },
    ]);
    expect(spotsOf({ ...graph, places: [place('p2', '')], destinations: [] })).toEqual([]);
  });
});

describe('mayBeSaid', () => {
  it('is of a connected robot that stands on a map, by somebody who may drive', () => {
    expect(mayBeSaid(robot, true, true)).toBe(true);
    expect(mayBeSaid({ ...robot, mission }, true, true)).toBe(true);
    expect(mayBeSaid(robot, false, true)).toBe(false);
    expect(mayBeSaid(robot, true, false)).toBe(false);
    expect(mayBeSaid({ ...robot, online: false }, true, true)).toBe(false);
    expect(mayBeSaid({ ...robot, map: null }, true, true)).toBe(false);
    for (const state of ['accepted', 'driving'] as const)
      expect(mayBeSaid({ ...robot, mission: { ...mission, state } }, true, true)).toBe(false);
  });
});

describe('the words of a said place', () => {
  it('are asked for where the robot does not know', () => {
    expect(needsWord(null)).toBe(true);
    expect(needsWord({ sureness: 'lost', share: 0, where: null })).toBe(true);
    expect(needsWord({ sureness: 'unsure', share: 0.3, where: 'in the hall' })).toBe(true);
    expect(needsWord({ sureness: 'fairly sure', share: 0.6, where: 'in the hall' })).toBe(false);
    expect(needsWord({ sureness: 'sure', share: 0.9, where: 'in the hall' })).toBe(false);
    expect(offerWords('Chair', true)).toBe('Say where Chair is');
    expect(offerWords('Chair', false)).toBe('Chair is somewhere else');
    expect(askWords('Chair')).toBe('Where is Chair?');
  });

  it('promise no more than the robot keeps', () => {
    const spot = { label: 'living_room', name: 'Living room', place: 'p1', image: 't/sofa.jpg' };
    expect(thanksWords(spot)).toBe(
      'Thank you. I take it that I am in the living room, unless I see something else.',
    );
    expect(thanksWords({ ...spot, label: "Anna's room" })).toContain("I am in Anna's room,");
  });
});
