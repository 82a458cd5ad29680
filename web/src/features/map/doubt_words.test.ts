// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { Doubt, Edit, Graph, LoggedEdit } from '../../api/types';
import {
  allSeenWords,
  answeredBy,
  massWords,
  questionOf,
  setAside,
  setAsideWords,
  standWords,
  worthWords,
} from './doubt_words';
import { effectsWords } from './edit_words';

const doubt = (part: Partial<Doubt> = {}): Doubt => ({
  kind: 'same_place',
  image_a: 't/p1.jpg',
  image_b: 't/p2.jpg',
  place_a: 'p1',
  place_b: 'p2',
  state: 'undecided',
  by: 'method',
  set_aside_by: null,
  probability: 0.45,
  effect: 0.6,
  weight: 0.27,
  masses_before: null,
  masses_after: null,
  support: 0.55,
  plausibility: 0.8,
  neighbours: [],
  reasons: [],
  if_yes: [],
  if_no: [],
  ...part,
});

describe('a doubt in words', () => {
  it('agrees with what the map does', () => {
    expect(standWords(doubt())).toBe(
      'The map leaves it open, and keeps them apart until somebody decides: it is between 55 % and 80 % sure that they are one place.',
    );
    expect(standWords(doubt({ state: 'accepted', support: 0.92 }))).toBe(
      'The map takes them for one place: what was seen makes it at least 92 % sure.',
    );
    expect(standWords(doubt({ state: 'rejected', plausibility: 0.15 }))).toBe(
      'The map keeps them apart: that they are one place is at most 15 % likely.',
    );
    expect(standWords(doubt({ state: 'rejected', by: 'person' }))).toBe(
      'Somebody has decided that they are two places.',
    );
    expect(standWords(doubt({ kind: 'way', state: 'accepted' }))).toMatch(/^The map has a way here/);
    expect(standWords(doubt({ kind: 'mixed_place', state: 'accepted', support: null }))).toBe(
      'The map takes them for one place.',
    );
  });

  it('says what a look is worth, and what the masses are', () => {
    expect(worthWords(doubt())).toBe(
      'The map is wrong here with a chance of 45 %. Much of it depends on that.',
    );
    expect(worthWords(doubt({ effect: 0.1 }))).toMatch(/Little of it/);
    expect(massWords({ true: 0.6, false: 0.1, unknown: 0.3 })).toBe(
      'for one place 60 %, not known 30 %, against it 10 %',
    );
    expect(questionOf(doubt({ kind: 'way' })).yes).toBe('Yes, there is a way');
  });
});

describe('what nobody is sure of', () => {
  const logged = (part: Partial<LoggedEdit>): LoggedEdit => ({
    kind: 'set_aside',
    image_a: 't/p1.jpg',
    image_b: 't/p2.jpg',
    text: 'same_place',
    images: [],
    by: 'ben',
    t_us: 0,
    undone: false,
    change: 1,
    redoable: false,
    lost: null,
    ...part,
  });

  it('says who was not sure', () => {
    expect(setAsideWords(doubt())).toBeNull();
    expect(setAsideWords(doubt({ set_aside_by: 'ben' }))).toBe('ben was not sure.');
  });

  it('is named at the end', () => {
    expect(allSeenWords([doubt()])).toBe('You have looked at all of these.');
    expect(allSeenWords([doubt({ set_aside_by: 'ben' }), doubt()])).toBe(
      'All of these were looked at. 1 of them was left open: somebody who knows the house well may be sure.',
    );
  });

  it('is saved about that doubt alone', () => {
    const { kind, ...about } = setAside(doubt({ kind: 'way' })) as Extract<Edit, { kind: 'set_aside' }>;
    expect([kind, about]).toEqual(['set_aside', { about: 'way', image_a: 't/p1.jpg', image_b: 't/p2.jpg' }]);
    expect(answeredBy([logged({})], doubt())).toBe(true);
    expect(answeredBy([logged({})], doubt({ kind: 'way' }))).toBe(false);
    expect(answeredBy([logged({ undone: true })], doubt())).toBe(false);
    expect(answeredBy([logged({ image_b: 't/p3.jpg' })], doubt())).toBe(false);
    expect(answeredBy([logged({ kind: 'decide', text: 'reject' })], doubt())).toBe(true);
  });
});

describe('what an answer would do', () => {
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
    places: [place('p1', 'hall'), place('p2', '')],
    edges: [],
    destinations: [],
    hypotheses: [],
    shortcuts: [],
  };
  const said = (...edits: Edit[]) => effectsWords(edits, graph);

  it('is said before it is saved', () => {
    const decide = { kind: 'decide' as const, prototype_a: 't/p1.jpg', prototype_b: 't/p2.jpg' };
    expect(said()).toBe('The map stays as it is.');
    expect(said({ ...decide, accept: true })).toBe('Hall and p2 become one place.');
    expect(said({ ...decide, accept: false })).toBe(
      'Hall and p2 stay two places, also when the map is built again.',
    );
    expect(said({ ...decide, prototype_b: 't/p1.jpg', accept: false })).toBe('Hall becomes two places.');
    expect(said({ kind: 'split', place: 'p1', images: ['t/a', 't/b'] })).toBe(
      '2 pictures leave Hall and become a place of their own.',
    );
    expect(said({ kind: 'set_aside', about: 'way', image_a: 't/p1.jpg', image_b: 't/p2.jpg' })).toBe(
      'The map stays as it is. This comes last from now on, and says that you were not sure.',
    );
    expect(said({ kind: 'remove_edge', from: 'p1', to: 'p2' })).toBe(
      'The way between Hall and p2 is removed.',
    );
  });
});
