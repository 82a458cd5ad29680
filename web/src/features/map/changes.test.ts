// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { Graph, LoggedEdit } from '../../api/types';
import { changesOf, changeWords, lostBecause, redoable, undoable } from './changes';

const edit = (change: number, part: Partial<LoggedEdit> = {}): LoggedEdit => ({
  kind: 'rename',
  image_a: 't/p1.jpg',
  image_b: null,
  text: 'porch',
  images: [],
  by: 'anna',
  t_us: 1000 * change,
  undone: false,
  change,
  redoable: false,
  lost: null,
  ...part,
});
const close = (change: number, image_a: string, image_b: string, part: Partial<LoggedEdit> = {}) =>
  edit(change, { kind: 'block_edge', text: 'true', image_a, image_b, ...part });
const taken_back = { undone: true, redoable: true };

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
  revision: 3,
  places: [place('p1', 'hall'), place('p2', 'kitchen')],
  edges: [],
  destinations: [],
  hypotheses: [],
  shortcuts: [],
};

describe('changesOf', () => {
  it('makes one change of what one request did', () => {
    const changes = changesOf([edit(1), close(2, 't/p1.jpg', 't/p2.jpg'), close(2, 't/p2.jpg', 't/p1.jpg')]);
    expect(changes.map((one) => [one.number, one.edits.length])).toEqual([
      [1, 1],
      [2, 2],
    ]);
    expect(undoable(changes)?.number).toBe(2);
    expect(redoable(changes)).toBeNull();
  });

  it('takes back the latest that stands, and makes again the earliest that was taken back', () => {
    const changes = changesOf([edit(1, { undone: true }), edit(2), edit(3, taken_back), edit(4, taken_back)]);
    expect([undoable(changes)?.number, redoable(changes)?.number]).toEqual([2, 3]);
    expect(undoable([])).toBeNull();
  });
});

describe('changeWords', () => {
  const words = (...edits: LoggedEdit[]) => changesOf(edits).map((one) => changeWords(one, graph));

  it('says what was done, and both directions of a way once', () => {
    expect(words(edit(1))).toEqual(['named a place “porch”']);
    expect(words(close(1, 't/p1.jpg', 't/p2.jpg'), close(1, 't/p2.jpg', 't/p1.jpg'))).toEqual([
      'closed a way: Hall – Kitchen',
    ]);
    expect(words(close(1, 't/p1.jpg', 't/p2.jpg', { text: 'false' }))).toEqual([
      'opened a way: Hall – Kitchen',
    ]);
    expect(words(edit(1, { kind: 'decide_shortcut', text: 'reject' }))).toEqual(['rejected a shortcut']);
  });

  it('says what somebody was not sure of, and of one place its name once', () => {
    const unsure = (text: string, image_b: string) => words(edit(1, { kind: 'set_aside', text, image_b }))[0];
    expect(unsure('same_place', 't/p2.jpg')).toBe('was not sure whether two places are one: Hall – Kitchen');
    expect(unsure('mixed_place', 't/p1.jpg')).toBe('was not sure whether a place is one: Hall');
    expect(unsure('way', 't/p9.jpg')).toBe('was not sure whether there is a way');
  });

  it('does without the names of places that are gone', () => {
    expect(words(close(1, 't/p8.jpg', 't/p9.jpg'), close(1, 't/p7.jpg', 't/p8.jpg'))).toEqual([
      'closed a way (2 times)',
    ]);
  });
});

describe('lostBecause', () => {
  it('says once why what stands could not be kept', () => {
    const why = 'Place p3 is not there.';
    const [one, other, none] = changesOf([
      edit(1, { lost: why }),
      edit(1, { lost: why }),
      edit(2, { lost: why, undone: true }),
      edit(3),
    ]).map(lostBecause);
    expect([one, other, none]).toEqual([[why], [], []]);
  });
});
