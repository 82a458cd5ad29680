// SPDX-License-Identifier: Apache-2.0
import type { PlanLines } from '../../api/types';

/** In the frame of the plan: metres, x to the right and y up on paper. */
export interface Spot {
  x_m: number;
  y_m: number;
}

export interface Bounds {
  left_m: number;
  right_m: number;
  bottom_m: number;
  top_m: number;
}

const kMargin = 0.04; // of the longer side
const kLeast_m = 1;

/** What has to be in sight: all walls, and all that is marked. */
export function boundsOf(lines: PlanLines, spots: readonly Spot[]): Bounds {
  const all = { left_m: Infinity, right_m: -Infinity, bottom_m: Infinity, top_m: -Infinity };
  const take = (x_m: number, y_m: number) => {
    all.left_m = Math.min(all.left_m, x_m);
    all.right_m = Math.max(all.right_m, x_m);
    all.bottom_m = Math.min(all.bottom_m, y_m);
    all.top_m = Math.max(all.top_m, y_m);
  };
  for (const { x1_m, y1_m, x2_m, y2_m } of lines.segments) {
    take(x1_m, y1_m);
    take(x2_m, y2_m);
  }
  for (const { x_m, y_m } of spots) take(x_m, y_m);
  if (all.left_m > all.right_m) return { left_m: 0, right_m: kLeast_m, bottom_m: 0, top_m: kLeast_m };
  const longer = Math.max(kLeast_m, all.right_m - all.left_m, all.top_m - all.bottom_m);
  const margin = kMargin * longer;
  return {
    left_m: all.left_m - margin,
    right_m: all.right_m + margin,
    bottom_m: all.bottom_m - margin,
    top_m: all.top_m + margin,
  };
}

/** The same as a viewBox, in metres, y downwards as pictures have it. */
export function viewBoxOf({ left_m, right_m, bottom_m, top_m }: Bounds): string {
  return [left_m, -top_m, right_m - left_m, top_m - bottom_m].map(short).join(' ');
}

/** All walls as one stroke. */
export function wallPath(lines: PlanLines): string {
  return lines.segments
    .map(({ x1_m, y1_m, x2_m, y2_m }) => `M${short(x1_m)} ${short(-y1_m)}L${short(x2_m)} ${short(-y2_m)}`)
    .join('');
}

export function wayPath(spots: readonly Spot[]): string {
  return spots.map(({ x_m, y_m }, i) => `${i === 0 ? 'M' : 'L'}${short(x_m)} ${short(-y_m)}`).join('');
}

/** Spots as dots of a round pen. */
export function dotPath(spots: readonly Spot[]): string {
  return spots.map(({ x_m, y_m }) => `M${short(x_m)} ${short(-y_m)}h0`).join('');
}

/** Where on the plan a drawing was pressed, `x` and `y` as shares of its width and height, from its top left corner. */
export function pressedAt(bounds: Bounds, x: number, y: number): Spot {
  return {
    x_m: toCentimetre(bounds.left_m + x * (bounds.right_m - bounds.left_m)),
    y_m: toCentimetre(bounds.top_m - y * (bounds.top_m - bounds.bottom_m)),
  };
}

export function toCentimetre(value_m: number): number {
  return Math.round(100 * value_m) / 100;
}

function short(value: number): string {
  return String(Math.round(1000 * value) / 1000);
}
