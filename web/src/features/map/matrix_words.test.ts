// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { Graph } from '../../api/types';
import { cellOf, cellWords, meantPicture, pictureTitle, tourRuns, verdictOf } from './matrix_words';

const images = ['t1/a.jpg', 't1/b.jpg', 't1/c.jpg', 't2/a.jpg', 't2/b.jpg'];
const pictures = {
  images,
  runs: tourRuns(images),
  tourName: (tour: string) => (tour === 't1' ? 'Ground floor' : 'Attic'),
};
const place = (id: string, label: string, ...members: string[]) => ({
  id,
  label,
  prototype: members[0] ?? '',
  members,
  features: 1,
  x: 0,
  y: 0,
});
const hypothesis = (prototype_a: string, prototype_b: string, decision: 'undecided' | 'rejected') =>
  ({ prototype_a, prototype_b, decision }) as Graph['hypotheses'][number];
const graph: Graph = {
  format: 'homeward-graph',
  version: 1,
  map: 'm',
  revision: 3,
  places: [
    place('p1', 'hall', 't1/a.jpg', 't1/b.jpg'),
    place('p2', 'kitchen', 't1/c.jpg'),
    place('p3', '', 't2/a.jpg'),
  ],
  edges: [],
  destinations: [],
  hypotheses: [
    hypothesis('t1/a.jpg', 't1/c.jpg', 'rejected'),
    hypothesis('t2/a.jpg', 't1/a.jpg', 'undecided'),
  ],
  shortcuts: [],
};

describe('pictures of the matrix', () => {
  it('are numbered within their tours', () => {
    expect(pictures.runs).toEqual([
      { tour: 't1', start: 0, end: 3 },
      { tour: 't2', start: 3, end: 5 },
    ]);
    expect(pictureTitle(2, pictures)).toBe('Picture 3 of Ground floor');
    expect(pictureTitle(3, pictures)).toBe('Picture 1 of Attic');
  });

  it('are said with their places and how the map has them', () => {
    const said = (column: number, row: number) => cellWords({ column, row }, pictures, graph);
    expect(said(2, 0)).toBe(
      'Picture 3 of Ground floor, the kitchen, and picture 1 of Ground floor, the hall. The map has looked at them and keeps their places apart.',
    );
    expect(said(1, 1)).toBe('Picture 2 of Ground floor, the hall, with itself.');
    expect(said(4, 0)).toMatch(/^Picture 2 of Attic, at no place of the map, and picture 1/);
  });

  it('have the colour that the map gives them', () => {
    const verdict = (column: number, row: number) => verdictOf({ column, row }, pictures, graph);
    expect([
      verdict(0, 1),
      verdict(1, 2),
      verdict(1, 3),
      verdict(2, 3),
      verdict(2, 2),
      verdict(0, 4),
    ]).toEqual(['one', 'apart', 'open', 'none', 'same', 'none']);
  });

  it('are meant by a number from 1, or by a place', () => {
    const meant = (text: string) => meantPicture(text, pictures, graph);
    expect([meant('1'), meant(' 5 '), meant('0'), meant('6'), meant('')]).toEqual([0, 4, null, null, null]);
    expect([meant('Kitchen'), meant('kit'), meant('p3'), meant('cellar')]).toEqual([2, 2, 3, null]);
  });

  it('are read from an address', () => {
    expect(cellOf([3, 1], 5)).toEqual({ column: 2, row: 0 });
    expect([cellOf([6, 1], 5), cellOf([0, 1], 5), cellOf([2], 5), cellOf([], 5)]).toEqual([
      null,
      null,
      null,
      null,
    ]);
  });
});
