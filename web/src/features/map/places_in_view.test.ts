// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { DrawnPlace } from './graph_content';
import { elementPlaces, nearestWithin } from './places_in_view';

/** A row of places, one unit apart; every tenth has a name. */
const row = (count: number): DrawnPlace[] =>
  Array.from({ length: count }, (_, i) => ({
    id: `p${i}`,
    name: i % 10 === 0 ? `Room ${i}` : null,
    tone: null,
    picture: '',
    x: i,
    y: 0,
  }));

const kAll = { x1: -1, x2: 5001, y1: -100, y2: 100 };

describe('the places that are elements of the drawing', () => {
  it('are all of a map that is not large', () => {
    const places = row(500);
    expect(elementPlaces(places, { x1: 0, x2: 10, y1: -5, y2: 5 }, 1)).toBe(places);
  });

  it('are of a large map those with a name, where places are small', () => {
    const some = elementPlaces(row(4000), kAll, 2);
    expect(some).toHaveLength(400);
    expect(some.every((one) => one.name !== null)).toBe(true);
  });

  it('are at most 500, those in view before those around it', () => {
    const some = elementPlaces(row(20_000), { x1: 10_000, x2: 14_000, y1: -100, y2: 100 }, 2);
    expect(some).toHaveLength(500);
    const inView = some.filter((one) => one.x > 10_000 && one.x < 14_000);
    expect(inView).toHaveLength(399);
  });

  it('are first of all those that a draft makes other', () => {
    const places = row(20_000).map((one, i) =>
      i >= 13_990 && i < 14_010 ? { ...one, name: '+', tone: 'added' as const } : one,
    );
    const some = elementPlaces(places, { x1: 10_000, x2: 14_000, y1: -100, y2: 100 }, 2);
    expect(some.slice(0, 10).every((one) => one.tone === 'added')).toBe(true);
    expect(some.filter((one) => one.tone !== null)).toHaveLength(20);
  });

  it('are all in view and around it where pictures can be seen', () => {
    const some = elementPlaces(row(5000), { x1: 1000, x2: 1100, y1: -10, y2: 10 }, 30);
    expect(some.map((one) => one.x).sort((a, b) => a - b)).toEqual(
      Array.from({ length: 199 }, (_, i) => 951 + i),
    );
  });
});

describe('a press on the drawing', () => {
  it('means the nearest place, unless all are too far away', () => {
    expect(nearestWithin(row(100), { x: 41.6, y: 0.5 }, 3)?.id).toBe('p42');
    expect(nearestWithin(row(100), { x: 41.6, y: 4 }, 3)).toBeNull();
    expect(nearestWithin([], { x: 0, y: 0 }, 3)).toBeNull();
  });
});
