// SPDX-License-Identifier: Apache-2.0
import type { Floor } from '../../api/types';

/** What a cell of the floor is, as its runs say it. */
export const kUnknown = 0;
export const kFree = 1;
export const kThing = 2;
export const kCovered = 3;

/** A rectangle in metres; y is up. */
export interface Bounds {
  left: number;
  right: number;
  bottom: number;
  top: number;
}

/** The floor as a picture has it: not larger than can be drawn, cells of a large one several together. */
export interface Raster {
  columns: number;
  rows: number;
  cell_m: number;
  x_m: number; // of the lower left corner
  y_m: number;
  kinds: Uint8Array; // rows from the least y on
  known: Bounds | null; // around all that is not unknown
}

// Of several cells that become one, a thing must not get lost; then what was seen best.
const kRanks = new Uint8Array([0, 1, 3, 2]);

/** Draws the runs of a floor into a raster of `most` columns and rows at most. Runs beyond its end are left out. */
export function rasterOf(floor: Floor, most = 2048): Raster {
  const step = Math.max(1, Math.ceil(Math.max(floor.columns, floor.rows) / most));
  const columns = Math.ceil(floor.columns / step);
  const rows = Math.ceil(floor.rows / step);
  const kinds = new Uint8Array(columns * rows);
  const seen = { left: Infinity, right: -Infinity, bottom: Infinity, top: -Infinity }; // in cells
  const paint = (row: number, from: number, to: number, kind: number) => {
    seen.left = Math.min(seen.left, from);
    seen.right = Math.max(seen.right, to);
    seen.bottom = Math.min(seen.bottom, row);
    seen.top = Math.max(seen.top, row + 1);
    const base = Math.floor(row / step) * columns;
    const first = base + Math.floor(from / step);
    const end = base + Math.floor((to - 1) / step) + 1;
    if (step === 1) kinds.fill(kind, first, end);
    else
      for (let i = first; i < end; i += 1)
        if ((kRanks[kind] ?? 0) > (kRanks[kinds[i] ?? 0] ?? 0)) kinds[i] = kind;
  };
  const cells = floor.columns * floor.rows;
  let at = 0;
  for (const run of floor.runs) {
    const kind = run % 4;
    const end = Math.min(cells, at + Math.floor(run / 4));
    while (kind !== kUnknown && at < end) {
      const row = Math.floor(at / floor.columns);
      const stop = Math.min(end, (row + 1) * floor.columns);
      paint(row, at - row * floor.columns, stop - row * floor.columns, kind);
      at = stop;
    }
    at = end;
  }
  const { cell_m, x_m, y_m } = floor;
  const known =
    seen.left === Infinity
      ? null
      : {
          left: x_m + seen.left * cell_m,
          right: x_m + seen.right * cell_m,
          bottom: y_m + seen.bottom * cell_m,
          top: y_m + seen.top * cell_m,
        };
  return { columns, rows, cell_m: cell_m * step, x_m, y_m, kinds, known };
}
