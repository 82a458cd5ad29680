// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { kCovered, kFree, kThing, rasterOf } from './floor';

const run = (count: number, kind: number) => 4 * count + kind;
const place = { cell_m: 0.1, x_m: -1, y_m: -0.5 };

describe('rasterOf', () => {
  it('reads runs row by row from the least y on, also over the ends of rows', () => {
    const floor = { ...place, columns: 4, rows: 2, runs: [8, 13, 6, 11] };
    expect([...rasterOf(floor).kinds]).toEqual([0, 0, 1, 1, 1, 2, 3, 3]);
    const over = { ...place, columns: 3, rows: 3, runs: [run(1, 0), run(5, 1), run(3, 2)] };
    expect([...rasterOf(over).kinds]).toEqual([0, 1, 1, 1, 1, 1, 2, 2, 2]);
  });

  it('tells the part that is known, in metres', () => {
    const floor = { ...place, columns: 10, rows: 4, runs: [run(13, 0), run(2, 1), run(9, 0), run(1, 2)] };
    const { known } = rasterOf(floor);
    expect(known?.left).toBeCloseTo(-0.7);
    expect(known?.right).toBeCloseTo(-0.5);
    expect(known?.bottom).toBeCloseTo(-0.4);
    expect(known?.top).toBeCloseTo(-0.2);
    expect(rasterOf({ ...place, columns: 2, rows: 1, runs: [run(2, 0)] }).known).toBeNull();
  });

  it('takes cells of a large floor together, and loses nothing that stands there', () => {
    const runs = [run(3, 1), run(1, 2), run(4, 3), run(4, 1), run(4, 0)];
    const raster = rasterOf({ ...place, columns: 4, rows: 4, runs }, 2);
    expect([raster.columns, raster.rows, raster.cell_m]).toEqual([2, 2, 0.2]);
    expect([...raster.kinds]).toEqual([kCovered, kThing, kFree, kFree]);
  });

  it('neither fails at runs that end early nor at those that go on too long', () => {
    expect([...rasterOf({ ...place, columns: 2, rows: 2, runs: [run(1, 1)] }).kinds]).toEqual([1, 0, 0, 0]);
    expect([...rasterOf({ ...place, columns: 2, rows: 1, runs: [run(9, 1)] }).kinds]).toEqual([1, 1]);
  });

  it('draws the largest floor that there may be in a moment', () => {
    const runs = Array.from({ length: 200_000 }, (_, n) => run(125, n % 4));
    const begun = performance.now();
    const raster = rasterOf({ ...place, columns: 5000, rows: 5000, runs });
    expect(raster.kinds.length).toBe(1667 * 1667);
    expect(performance.now() - begun).toBeLessThan(2000);
  });
});
