// SPDX-License-Identifier: Apache-2.0
// What of the matrix is shown: x across and y down from its upper left corner, in pictures.

/** Two pictures by their numbers in the matrix, from 0. */
export interface Cell {
  column: number;
  row: number;
}

export interface MatrixView {
  x: number; // at the left edge
  y: number; // at the upper edge
  scale: number; // screen pixels a picture
}

/** What the server draws. */
export interface Sheet {
  count: number; // pictures each way
  tile_px: number;
  levels: number;
}

export interface Size {
  width: number;
  height: number;
}

/** A square of the matrix: what to ask for, and where it stands on the screen. */
export interface Tile {
  level: number;
  column: number;
  row: number;
  left: number;
  top: number;
  width: number;
  height: number;
}

const kLargestCell_px = 96;

const clamp = (value: number, least: number, most: number) => Math.max(least, Math.min(most, value));

function leastScale(count: number, { width, height }: Size): number {
  return Math.min(width, height) / Math.max(1, count);
}

/** The whole matrix, in the middle. */
export function wholeView(count: number, size: Size): MatrixView {
  return within({ x: 0, y: 0, scale: leastScale(count, size) }, count, size);
}

/** The nearest view that wastes no room beside the matrix. */
export function within(view: MatrixView, count: number, size: Size): MatrixView {
  const least = leastScale(count, size);
  const scale = clamp(view.scale, least, Math.max(least, kLargestCell_px));
  const along = (from: number, length_px: number) => {
    const shown = length_px / scale;
    return shown >= count ? (count - shown) / 2 : clamp(from, 0, count - shown);
  };
  return { x: along(view.x, size.width), y: along(view.y, size.height), scale };
}

/** Larger by `factor` about a point of the screen, which stays where it is. */
export function zoomed(
  view: MatrixView,
  factor: number,
  at: { x: number; y: number },
  count: number,
  size: Size,
): MatrixView {
  const { scale } = within({ ...view, scale: view.scale * factor }, count, size);
  const shift = 1 / view.scale - 1 / scale;
  return within({ x: view.x + at.x * shift, y: view.y + at.y * shift, scale }, count, size);
}

/** Moved by screen pixels, as a hand moves a sheet of paper. */
export function moved(view: MatrixView, dx: number, dy: number, count: number, size: Size): MatrixView {
  return within({ ...view, x: view.x - dx / view.scale, y: view.y - dy / view.scale }, count, size);
}

/** Moved as little as shows a cell with some room about it. */
export function showing(view: MatrixView, cell: Cell, count: number, size: Size): MatrixView {
  const along = (from: number, at: number, length_px: number) => {
    const shown = length_px / view.scale;
    const room = Math.min(shown / 4, 24 / view.scale);
    return clamp(from, at + 1 + room - shown, at - room);
  };
  const x = along(view.x, cell.column, size.width);
  const y = along(view.y, cell.row, size.height);
  return within({ ...view, x, y }, count, size);
}

/** With a cell in the middle, at so many screen pixels a picture or more. */
export function centred(view: MatrixView, cell: Cell, least: number, count: number, size: Size): MatrixView {
  const { scale } = within({ ...view, scale: Math.max(least, view.scale) }, count, size);
  const x = cell.column + 0.5 - size.width / scale / 2;
  const y = cell.row + 0.5 - size.height / scale / 2;
  return within({ x, y, scale }, count, size);
}

/** The cell at a point of the screen; null beside the matrix. */
export function cellAt(view: MatrixView, at: { x: number; y: number }, count: number): Cell | null {
  const [column, row] = [Math.floor(view.x + at.x / view.scale), Math.floor(view.y + at.y / view.scale)];
  const inside = (one: number) => one >= 0 && one < count;
  return inside(column) && inside(row) ? { column, row } : null;
}

/** The finest level of which no pixel is smaller than one of the screen. */
export function levelOf(scale: number, levels: number): number {
  return clamp(Math.ceil(-Math.log2(scale)), 0, levels - 1);
}

/** The tiles of a level that are in view. */
export function tilesInView(view: MatrixView, sheet: Sheet, size: Size, level: number): Tile[] {
  const span = sheet.tile_px * 2 ** level; // pictures
  const range = (from: number, length_px: number) => {
    const first = Math.floor(Math.max(0, from) / span);
    const end = Math.ceil(Math.min(sheet.count, from + length_px / view.scale) / span);
    return Array.from({ length: Math.max(0, end - first) }, (_, i) => first + i);
  };
  // Both edges are rounded alike, so that neighbours meet without a seam.
  const edge = (index: number, from: number) => Math.round((index * span - from) * view.scale);
  return range(view.y, size.height).flatMap((row) =>
    range(view.x, size.width).map((column) => {
      const [left, top] = [edge(column, view.x), edge(row, view.y)];
      const [width, height] = [edge(column + 1, view.x) - left, edge(row + 1, view.y) - top];
      return { level, column, row, left, top, width, height };
    }),
  );
}

/** A picture of the strip along an edge: it stands for `step` pictures. */
export interface StripPicture {
  picture: number;
  start_px: number;
  length_px: number;
}

/** The pictures along an edge, each at least `least_px` long, of those in view. */
export function stripInView(from: number, scale: number, length_px: number, count: number, least_px: number) {
  const step = 2 ** Math.max(0, Math.ceil(Math.log2(least_px / scale)));
  const first = Math.floor(Math.max(0, from) / step);
  const end = Math.ceil(Math.min(count, from + length_px / scale) / step);
  return Array.from({ length: Math.max(0, end - first) }, (_, i): StripPicture => {
    const start = (first + i) * step;
    const [start_px, end_px] = [start, Math.min(count, start + step)].map((at) =>
      Math.round((at - from) * scale),
    ) as [number, number];
    return {
      picture: Math.min(count - 1, start + Math.floor(step / 2)),
      start_px,
      length_px: end_px - start_px,
    };
  });
}

const kKeyStep_px = 8;

/** How many pictures an arrow key moves: one where they can be told from each other, else what can be seen to move. */
export function keyStep(scale: number): number {
  return Math.max(1, Math.round(kKeyStep_px / scale));
}
