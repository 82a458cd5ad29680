// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { MapPlan } from '../../api/types';
import { numberIn, pinsOf, placed, spotOf, tieOf, troubleOf, type Pin } from './pins';

const tie: MapPlan = {
  map: 'm1',
  revision: 3,
  plan: 'plan1',
  version: 1,
  newest_version: 1,
  tied_us: 5,
  by: 'anna',
  pins: [
    { image: 't1/1.jpg', place: 'p1', x_m: 1.5, y_m: 2, theta_rad: Math.PI / 2 },
    { image: 't0/gone.jpg', place: null, x_m: 3, y_m: 2, theta_rad: null },
  ],
  rms_m: null,
  places: [],
  unplaced: [],
};
const pin = (place: string, x: string, y: string, degrees = ''): Pin => ({
  place,
  image: null,
  x,
  y,
  degrees,
});

describe('pins of places on a plan', () => {
  it('begin with those that are kept, without lost ones', () => {
    expect(pinsOf(tie)).toEqual([{ place: 'p1', image: 't1/1.jpg', x: '1.5', y: '2', degrees: '90' }]);
    expect(pinsOf(null)).toEqual([]);
  });

  it('are put and moved by presses', () => {
    const first = placed([], 'p1', { x_m: 1, y_m: 2 });
    expect(first).toEqual([pin('p1', '1', '2')]);
    const two = placed(first, 'p2', { x_m: 4, y_m: 2 });
    expect(placed(two, 'p1', { x_m: 0.5, y_m: 2 })).toEqual([pin('p1', '0.5', '2'), pin('p2', '4', '2')]);
  });

  it('are numbers as people type them', () => {
    expect([numberIn(' 4,25', 100), numberIn('-.5', 100), numberIn('+3.', 100)]).toEqual([4.25, -0.5, 3]);
    expect(['', '1e5', '4 m', '1.2.3', '101'].map((text) => numberIn(text, 100))).toEqual([
      null,
      null,
      null,
      null,
      null,
    ]);
    expect(spotOf(pin('p1', '1', 'x'))).toBeNull();
    expect(troubleOf(pin('p1', '1', ''))).toContain('metres');
    expect(troubleOf(pin('p1', '1', '2', '400'))).toContain('degrees');
    expect(troubleOf(pin('p1', '1', '2'))).toBeNull();
  });

  it('are sent once two of them are whole, old ones by their picture', () => {
    expect(tieOf('plan1', 2, [pin('p1', '1', '2')])).toBeNull();
    expect(tieOf('plan1', 2, [pin('p1', '1', '2'), pin('p2', '', '2')])).toBeNull();
    const kept = { ...pin('p2', '4', '2', '270'), image: 't1/9.jpg' };
    const sent = tieOf('plan1', 2, [pin('p1', '1', '2'), kept]);
    expect(sent).toEqual({
      plan: 'plan1',
      version: 2,
      pins: [
        { place: 'p1', x_m: 1, y_m: 2, theta_rad: null },
        { image: 't1/9.jpg', x_m: 4, y_m: 2, theta_rad: expect.closeTo(-Math.PI / 2, 9) as number },
      ],
    });
  });
});
