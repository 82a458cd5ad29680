// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { Edge, Graph, Place } from '../../api/types';
import { contentOf } from './graph_content';

const place = (id: string, label: string, x: number | null): Place => ({
  id,
  label,
  prototype: `t/${id}.jpg`,
  members: [`t/${id}.jpg`],
  features: 1,
  x,
  y: x,
});
const edge = (from: string, to: string): Edge => ({
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
});
const graphOf = (places: Graph['places'], edges: Graph['edges']): Graph => ({
  format: 'homeward-graph',
  version: 1,
  map: 'm',
  revision: 3,
  places,
  edges,
  destinations: [],
  hypotheses: [],
  shortcuts: [],
});
const before = graphOf(
  [place('p1', 'hall', 0), place('p2', '', 0.5), place('p3', 'bath', 1)],
  [edge('p1', 'p2'), edge('p2', 'p1'), edge('p2', 'p3')],
);

describe('what is drawn of a map', () => {
  it('is each place in units of the drawing, with its name where it has one, and one line for both directions', () => {
    const { places, lines, at } = contentOf(before, null);
    expect(places.map(({ id, name, tone, x, y }) => [id, name, tone, x, y])).toEqual([
      ['p3', 'Bath', null, 1000, 1000],
      ['p1', 'Hall', null, 0, 0],
      ['p2', null, null, 500, 500],
    ]);
    expect(lines.map(({ id }) => id)).toEqual(['p1|p2', 'p2|p3']);
    expect(at.get('p2')?.picture).toContain('p2.jpg');
  });

  it('shows with a draft what is gone and what is new', () => {
    const after = graphOf([place('p1', 'hall', 0), place('p2', '', 0.5)], [edge('p1', 'p2')]);
    const marks = {
      before,
      places: new Map([['p3', 'removed'] as const]),
      lines: new Map([['p2|p3', 'removed'] as const]),
    };
    const { places, lines } = contentOf(after, marks);
    expect(places.find(({ id }) => id === 'p3')).toMatchObject({ name: '− Bath', tone: 'removed' });
    expect(lines.map(({ id, look }) => [id, look.sign])).toEqual([
      ['p1|p2', null],
      ['p2|p3', '−'],
    ]);
  });

  it('leaves out a shortcut to a place that is not there', () => {
    const shortcut = {
      place_a: 'p1',
      place_b: 'p3',
      image_a: 't/p1.jpg',
      image_b: 't/p3.jpg',
      state: 'proposed',
      by: 'method',
      length_m: 1,
      way_m: 4,
      clear_m: 1,
      confidence: 0.9,
      inliers: 30,
    } as Graph['shortcuts'][number];
    expect(contentOf({ ...before, shortcuts: [shortcut] }, null).lines.map(({ id }) => id)).toContain(
      'shortcut:p1|p3',
    );
    const gone = { ...before, shortcuts: [{ ...shortcut, place_b: 'p9' }] };
    expect(contentOf(gone, null).lines).toHaveLength(2);
  });

  it('puts places where it is told to', () => {
    const graph = graphOf([place('p1', '', null)], []);
    expect(contentOf(graph, null, new Map([['p1', { x: 3, y: 4 }]])).places[0]).toMatchObject({ x: 3, y: 4 });
    expect(contentOf(graph, null).places[0]).toMatchObject({ x: 0, y: 0 });
  });
});
