// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { Difference, Graph } from '../../api/types';
import { differenceLines } from './difference_words';

const place = (id: string, label: string) => ({
  id,
  label,
  prototype: `t/${id}.jpg`,
  members: [`t/${id}.jpg`],
  features: 1,
  x: 0,
  y: 0,
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
const before = graphOf(place('p1', 'hall'), place('p2', 'kitchen'));
const after = graphOf(place('p1', 'hall'), place('p3', 'pantry'));
const difference = (part: Partial<Difference>): Difference => ({
  format: 'homeward-difference',
  version: 1,
  places: [],
  edges: [],
  destinations: [],
  hypotheses: [],
  parts_before: 1,
  parts_after: 1,
  ...part,
});
const lines = (part: Partial<Difference>) =>
  differenceLines(difference(part), before, after).map(({ tone, words, place: at }) => [tone, words, at]);

describe('what is other with a draft', () => {
  it('is said of places', () => {
    const state = (label: string) => ({ label, prototype: 't/p1.jpg', images: 2 });
    const same = { gained: [], left: [] };
    expect(
      lines({
        places: [
          { id: 'p3', change: 'added', before: null, after: state('pantry'), ...same },
          { id: 'p2', change: 'removed', before: state('kitchen'), after: null, ...same },
          {
            id: 'p1',
            change: 'changed',
            before: state('hall'),
            after: state('porch'),
            gained: ['t/a'],
            left: [],
          },
        ],
      }),
    ).toEqual([
      ['added', 'Pantry is a new place, with 2 pictures.', 'p3'],
      ['removed', 'Kitchen is no place any more.', null],
      ['changed', '“hall” is called “porch” now.', 'p1'],
      ['changed', 'Hall gained 1 picture.', 'p1'],
    ]);
  });

  it('is said once of both directions of a way that share it', () => {
    const open = { bearing_rad: 0, weak: false, blocked: false, shortcut: false, by: 'method' as const };
    const closed = { ...open, blocked: true };
    const way = (from: string, to: string, was: typeof open | null, is: typeof open | null) => ({
      from,
      to,
      change: was === null ? ('added' as const) : is === null ? ('removed' as const) : ('changed' as const),
      before: was,
      after: is,
    });
    expect(
      lines({
        edges: [way('p1', 'p3', null, open), way('p3', 'p1', null, open), way('p1', 'p2', open, closed)],
      }),
    ).toEqual([
      ['added', 'The way between Hall and Pantry is new.', 'p3'],
      ['changed', 'The way from Hall to Kitchen is closed.', 'p1'],
    ]);
  });

  it('is said of destinations, decisions and the parts of the map', () => {
    const desk = { place: 'p1', image: 't/p1.jpg', label: 'desk', pictogram: '' as const };
    expect(
      lines({
        parts_after: 2,
        destinations: [
          { id: 'd1', change: 'added', before: null, after: desk },
          {
            id: 'd2',
            change: 'changed',
            before: desk,
            after: { ...desk, label: 'writing_desk', pictogram: 'desk' },
          },
        ],
        hypotheses: [
          { prototype_a: 't/p1.jpg', prototype_b: 't/p2.jpg', before: 'undecided', after: 'rejected' },
        ],
      }),
    ).toEqual([
      ['removed', 'The map falls into 2 parts that the chair cannot drive between; it was 1.', null],
      ['added', 'Riders can be sent to Desk.', 'p1'],
      ['changed', 'The destination Desk is called Writing desk now.', 'p1'],
      ['changed', 'The card of Writing desk has another sign.', 'p1'],
      ['changed', 'It is decided: Hall and Kitchen are two places.', 'p1'],
    ]);
  });
});
