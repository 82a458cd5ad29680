// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { ProblemError } from '../../api/problem';
import type { Edit, Graph } from '../../api/types';
import { concernedPictures } from './concerned';

const place = (id: string, members: string[]) => ({
  id,
  label: '',
  prototype: members[0] ?? '',
  members,
  features: 1,
  x: 0,
  y: 0,
});
const graph: Graph = {
  format: 'homeward-graph',
  version: 1,
  map: 'm',
  revision: 3,
  places: [place('p1', ['t/a.jpg', 't/b.jpg']), place('p2', ['t/c.jpg'])],
  edges: [],
  destinations: [{ id: 'd1', place: 'p2', image: 't/c.jpg', label: 'desk', pictogram: '' }],
  hypotheses: [],
  shortcuts: [],
};
const refused = (message: string, where?: string) => new ProblemError('invalid_input', 422, message, where);

describe('the pictures of a refusal', () => {
  it('are those that its words name, pictures before places', () => {
    expect(concernedPictures(refused('Place p1 does not hold the image t/c.jpg.'), [], graph)).toEqual([
      't/c.jpg',
    ]);
    expect(concernedPictures(refused("The picture t/a.jpg is the destination 'desk'."), [], graph)).toEqual([
      't/a.jpg',
    ]);
    expect(concernedPictures(refused('Both images are in place p1.'), [], graph)).toEqual(['t/a.jpg']);
  });

  it('are those of the edit that was refused where the words name none', () => {
    const edits: Edit[] = [
      { kind: 'delete', place: 'p1' },
      { kind: 'name_destination', destination: 'd1', label: '' },
      { kind: 'split', place: 'p1', images: ['t/b.jpg'] },
    ];
    const of = (where: string) => concernedPictures(refused('No.', where), edits, graph);
    expect(of('body/edits/1')).toEqual(['t/c.jpg']);
    expect(of('body/edits/2/images')).toEqual(['t/b.jpg']);
    expect(of('If-Match')).toEqual([]);
  });
});
