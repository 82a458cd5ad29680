// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { MapInfo, Tour } from '../../api/types';
import { offeredTours, suggested } from './tour_choice';

const tour = (id: string, state: Tour['state'] = 'complete') => ({ id, state }) as Tour;
const map = (tours: string[], state: MapInfo['state'] = 'ready') => ({ state, tours }) as MapInfo;

describe('suggested', () => {
  it('is the tour that no map was made from yet', () => {
    expect(suggested([tour('a'), tour('b')], [map(['a'])])).toBe('b');
    expect(suggested([tour('a')], [])).toBe('a');
    expect(suggested([tour('a')], [map(['a'], 'failed')])).toBe('a');
  });

  it('is none where tours might be of different buildings, or all have their map', () => {
    expect(suggested([tour('a'), tour('b'), tour('c')], [map(['a'])])).toBeNull();
    expect(suggested([tour('a'), tour('b')], [map(['a']), map(['b'], 'building')])).toBeNull();
    expect(suggested([], [])).toBeNull();
  });
});

it('offers complete tours, and to a map those that it lacks', () => {
  const tours = [tour('a'), tour('b'), tour('c', 'open')];
  expect(offeredTours(tours, null).map((one) => one.id)).toEqual(['a', 'b']);
  expect(offeredTours(tours, map(['a'])).map((one) => one.id)).toEqual(['b']);
});
