// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import {
  cellAt,
  centred,
  keyStep,
  levelOf,
  moved,
  showing,
  stripInView,
  tilesInView,
  wholeView,
  within,
  zoomed,
} from './matrix_view';

const size = { width: 600, height: 500 };
const sheet = { count: 25_000, tile_px: 256, levels: 8 };
const whole = wholeView(sheet.count, size);

describe('a view of the matrix', () => {
  it('shows all, in the middle, and never less large', () => {
    expect(whole.scale).toBe(0.02);
    expect([whole.x, whole.y]).toEqual([-2500, 0]);
    expect(zoomed(whole, 0.5, { x: 0, y: 0 }, sheet.count, size)).toEqual(whole);
  });

  it('keeps the point about which it grows', () => {
    const at = { x: 320, y: 200 };
    const grown = zoomed(whole, 16, at, sheet.count, size);
    expect(cellAt(grown, at, sheet.count)).toEqual(cellAt(whole, at, sheet.count));
    expect(grown.scale).toBeCloseTo(0.32);
  });

  it('ends at the edges and at the largest cell', () => {
    const grown = zoomed(whole, 1e9, { x: 0, y: 0 }, sheet.count, size);
    expect(grown.scale).toBe(96);
    expect(moved(grown, 1e9, 1e9, sheet.count, size)).toEqual({ x: 0, y: 0, scale: 96 });
    expect(moved(grown, 0, -1e9, sheet.count, size).y).toBeCloseTo(25_000 - 500 / 96);
  });

  it('is larger than the largest cell where few pictures fill it', () => {
    expect(within({ x: 0, y: 0, scale: 1 }, 2, size).scale).toBe(250);
  });

  it('comes to a cell by as little as is needed, or with the cell in its middle', () => {
    const near = { x: 100, y: 100, scale: 10 };
    expect(showing(near, { column: 120, row: 120 }, sheet.count, size)).toEqual(near);
    const after = showing(near, { column: 500, row: 120 }, sheet.count, size);
    expect([after.x, after.y]).toEqual([501 + 2.4 - 60, 100]);
    const middle = centred(whole, { column: 4000, row: 9000 }, 12, sheet.count, size);
    expect(cellAt(middle, { x: 300, y: 250 }, sheet.count)).toEqual({ column: 4000, row: 9000 });
    expect(middle.scale).toBe(12);
  });

  it('knows no cell beside the matrix', () => {
    expect(cellAt(whole, { x: 1, y: 1 }, sheet.count)).toBeNull();
  });
});

describe('the tiles of a view', () => {
  it('are of the level whose pixels are not smaller than the screen’s', () => {
    expect([levelOf(2, 8), levelOf(1, 8), levelOf(0.9, 8), levelOf(0.02, 8), levelOf(1e-6, 8)]).toEqual([
      0, 0, 1, 6, 7,
    ]);
  });

  it('are few at every size, cover what is in view, and meet', () => {
    for (let view = whole; view.scale < 90; view = zoomed(view, 1.7, { x: 311, y: 207 }, sheet.count, size)) {
      const tiles = tilesInView(view, sheet, size, levelOf(view.scale, sheet.levels));
      expect(tiles.length).toBeLessThanOrEqual(16);
      expect(Math.min(...tiles.map((one) => one.top))).toBeLessThanOrEqual(Math.max(0, -view.y * view.scale));
      for (const one of tiles) {
        const right = tiles.find((other) => other.row === one.row && other.column === one.column + 1);
        if (right) expect(right.left).toBe(one.left + one.width);
      }
    }
  });

  it('are none that the matrix does not have', () => {
    const tiles = tilesInView(whole, sheet, size, 7);
    expect(tiles.map(({ column, row }) => [column, row])).toEqual([[0, 0]]);
  });
});

describe('the pictures along an edge', () => {
  it('are few at every size, and one for each where there is room', () => {
    const out = stripInView(0, 0.02, 500, 25_000, 60);
    expect(out.map((one) => one.picture)).toEqual(
      [2048, 6144, 10240, 14336, 18432, 22528, 24999].filter((_, i) => i < out.length),
    );
    expect(out.reduce((sum, one) => sum + one.length_px, 0)).toBe(500);
    const close = stripInView(1000.5, 96, 600, 25_000, 60);
    expect(close.map((one) => one.picture)).toEqual([1000, 1001, 1002, 1003, 1004, 1005, 1006]);
    expect(close[0]?.start_px).toBe(-48);
    for (const scale of [0.02, 0.3, 1, 7, 59]) {
      const strip = stripInView(0, scale, 600, 25_000, 60);
      expect(strip.length).toBeLessThanOrEqual(11);
    }
  });
});

describe('an arrow key', () => {
  it('moves one picture where they are told apart, and what can be seen to move elsewhere', () => {
    expect([keyStep(20), keyStep(0.02)]).toEqual([1, 400]);
  });
});
