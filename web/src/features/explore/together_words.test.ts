// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { Exploration, Robot } from '../../api/types';
import { bondOf, bondWords, goesOn, isFree, offerWords, told, unheard, type Party } from './together_words';

type Companion = Exploration['companion'];

const exploration = (
  id: string,
  companion: Companion = null,
  more: Partial<Exploration> = {},
): Exploration => ({
  id,
  phase: 'exploring',
  reason: null,
  pictures: 5,
  driven_m: 2,
  explored_s: 30,
  unreached: 0,
  pose: null,
  target: null,
  nodes: [],
  loops: [],
  floor: null,
  fences: [],
  uploaded: 0,
  tour: null,
  companion,
  ...more,
});
const shared = (of: string, joined = false, pictures = 3): Companion => ({
  exploration: of,
  joined,
  pictures,
});
const party = (id: string, name: string, one: Exploration | null, online = true): Party => ({
  robot: { id, name, online, lease: null } as Robot,
  exploration: one,
});
const bruno = (companion: Companion = null, more: Partial<Exploration> = {}, online = true) =>
  party('r2', 'Bruno', exploration('x2', companion, more), online);
const words = (companion: Companion, others: Party[]) => {
  const own = exploration('x1', companion);
  return bondWords(bondOf(own, others), 'Chair', own);
};

describe('goesOn', () => {
  it('is of a connected robot whose exploration is not over', () => {
    expect(goesOn(bruno())).toBe(true);
    expect(goesOn(bruno(null, { phase: 'paused' }))).toBe(true);
    for (const phase of ['ended', 'uploaded'] as const) expect(goesOn(bruno(null, { phase }))).toBe(false);
    expect(goesOn(bruno(null, {}, false))).toBe(false);
    expect(goesOn(party('r2', 'Bruno', null))).toBe(false);
  });
});

describe('the words of two that map a building', () => {
  it('are none where a robot shares with none', () => {
    expect(bondOf(exploration('x1'), [bruno(shared('x1'))])).toEqual({ kind: 'none' });
    expect(words(null, [bruno()])).toBeNull();
  });

  it('take no robot from another one', () => {
    expect([isFree(bruno()), isFree(bruno(shared('x7')))]).toEqual([true, false]);
  });

  it('say that one half is left to do until the other one shares as well', () => {
    for (const theirs of [null, shared('x7')]) {
      const half = words(shared('x2'), [bruno(theirs)]);
      expect(half?.pill).toBe('Half done');
      expect(half?.says).toMatch(/^Chair shares with Bruno, but Bruno not with Chair\./);
    }
  });

  it('tell whether they are joined, and what has arrived', () => {
    const looking = words(shared('x2', false, 1), [bruno(shared('x1'))]);
    expect([looking?.pill, looking?.tone]).toEqual(['Not joined yet', 'warn']);
    expect(looking?.says).toMatch(/^Chair has 1 picture of Bruno and looks for/);
    const joined = words(shared('x2', true, 12), [bruno(shared('x1'))]);
    expect([joined?.pill, joined?.tone]).toEqual(['Joined', 'good']);
    expect(joined?.says).toMatch(/It has 12 pictures of it, and leaves to Bruno/);
    const standing = words(shared('x2', true, 12), [bruno(shared('x1'), { phase: 'paused' })]);
    expect(standing?.says).toMatch(/and sees to all that Bruno, which stands, has not covered\.$/);
  });

  it('say that one is not heard of which is not connected, or is at something else', () => {
    const gone = words(shared('x2', true), [bruno(shared('x1'), {}, false)]);
    expect([gone?.pill, gone?.says]).toEqual([
      'Not heard of',
      'Nothing is heard of Bruno. Until it is, Chair goes on by itself.',
    ]);
    expect(words(shared('x9', true), [bruno(shared('x1'))])?.says).toMatch(
      /^Nothing is heard of the other robot\. It is gone, or has begun another exploration/,
    );
    const over = words(shared('x2', true), [bruno(shared('x1'), { phase: 'uploaded' })]);
    expect([over?.pill, over?.says]).toEqual(['Over', 'Bruno is done. Chair goes on by itself.']);
  });
});

it('says of each robot that could be chosen how far it is', () => {
  const own = exploration('x1');
  expect(offerWords(bruno(), own)).toBe('Maps the building, 5 pictures.');
  expect(offerWords(bruno(shared('x1'), { phase: 'paused', pictures: 1 }), own)).toBe(
    'Paused, 1 picture, shares with this one already.',
  );
  expect(offerWords(bruno(shared('x7')), own)).toBe(
    'Maps the building, 5 pictures, shares with another one.',
  );
});

describe('what was told', () => {
  const chair = (companion: Companion) => party('r1', 'Chair', exploration('x1', companion));

  it('is waited for until each says that it knows, one after the other', () => {
    const sent = [told(chair(null), 'x2'), told(bruno(), 'x1')];
    expect(unheard(sent, [chair(null), bruno()])).toBe('Chair');
    expect(unheard(sent, [chair(shared('x2')), bruno()])).toBe('Bruno');
    expect(unheard(sent, [chair(shared('x2')), bruno(shared('x1'))])).toBeNull();
  });

  it('is waited for no more where the robot says anything else, or explores anew', () => {
    const sent = [told(chair(shared('x2')), null)];
    expect(unheard(sent, [chair(shared('x2'))])).toBe('Chair');
    expect(unheard(sent, [chair(shared('x7'))])).toBeNull();
    expect(unheard(sent, [party('r1', 'Chair', exploration('x3', shared('x2')))])).toBeNull();
    expect(unheard([told(chair(shared('x2')), 'x2')], [chair(shared('x2'))])).toBeNull();
    expect(unheard([], [chair(null)])).toBeNull();
  });
});
