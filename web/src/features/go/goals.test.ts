// SPDX-License-Identifier: Apache-2.0
import { expect, it } from 'vitest';
import type { Graph } from '../../api/types';
import { goalsOf, leadsTo, targetOf } from './goals';
import { journeyOf } from './journey';

const place = (id: string, label: string) => ({
  id,
  label,
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
  revision: 1,
  places: [place('p1', 'kitchen'), place('p2', ''), place('p3', "anna's chair")],
  edges: [],
  destinations: [{ id: 'd1', place: 'p1', image: 't/p1.jpg', label: 'kitchen', pictogram: '' }],
  hypotheses: [],
  shortcuts: [],
};

it('offers the destinations and every other place with a name, each once', () => {
  expect(goalsOf(graph).map((one) => [one.name, targetOf(one)])).toEqual([
    ['Kitchen', { destination: 'd1', label: 'Kitchen' }],
    ["Anna's chair", { place: 'p3', label: "Anna's chair" }],
  ]);
});

it('calls a destination by the name that its place was given since, where it is the only one there', () => {
  const renamed = { ...graph, places: [place('p1', 'Cooking corner')] };
  expect(goalsOf(renamed).map((one) => one.name)).toEqual(['Cooking corner']);
  const two: Graph['destinations'] = [
    ...graph.destinations,
    { id: 'd2', place: 'p1', image: 't/p1b.jpg', label: 'sink', pictogram: '' },
  ];
  expect(goalsOf({ ...renamed, destinations: two }).map((one) => one.name)).toEqual(['Kitchen', 'Sink']);
});

it('knows which goal a journey leads to', () => {
  const robot = {
    id: 'r',
    name: 'Chair',
    online: true,
    map: 'm',
    state: null,
    belief: null,
    mission: null,
    lease: null,
    status_age_ms: null,
  };
  const [kitchen, chair] = goalsOf(graph);
  const journey = journeyOf(robot, { kind: 'asking', target: { place: 'p3', label: 'x' } });
  if (!kitchen || !chair || !journey) throw new Error('they are there');
  expect([leadsTo(journey, kitchen), leadsTo(journey, chair)]).toEqual([false, true]);
});
