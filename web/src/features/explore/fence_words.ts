// SPDX-License-Identifier: Apache-2.0
import type { Fences } from '../../api/types';
import { count } from '../../lib/words';
import type { Point } from './plan_view';

export type Fence = readonly Point[];

export const kLeastCorners = 3;
export const kMostCorners = 100;
const kFarthest_m = 100_000;

/** The fences as points. */
export function fencesOf(told: Fences): Fence[] {
  return told.map((fence) => fence.map(([x = 0, y = 0]) => [x, y] as const));
}

/** To the centimetre; nobody taps better. */
export function corner([x, y]: Point): Point {
  return [Math.round(x * 100) / 100, Math.round(y * 100) / 100];
}

/** What is sent; the contract has lists that may be changed. */
export function told(fences: readonly Fence[]): Fences {
  return fences.map((fence) => fence.map(([x, y]) => [x, y]));
}

/** Whether both keep off the same, to the centimetre. */
export function sameFences(a: readonly Fence[], b: readonly Fence[]): boolean {
  const written = (fences: readonly Fence[]) => JSON.stringify(fences.map((one) => one.map(corner)));
  return written(a) === written(b);
}

/** A number as people type it; null: nothing, undefined: no number. */
export function numberOf(text: string): number | null | undefined {
  const plain = text.trim().replace(',', '.').replace('−', '-');
  if (plain === '') return null;
  const value = /^[-+]?(\d+\.?\d*|\.\d+)$/.test(plain) ? Number(plain) : NaN;
  return Number.isFinite(value) ? value : undefined;
}

/** The corner that two fields say; null: none. */
export function typedCorner(x: string, y: string): Point | null {
  const [at_x, at_y] = [numberOf(x), numberOf(y)];
  if (typeof at_x !== 'number' || typeof at_y !== 'number') return null;
  return Math.max(Math.abs(at_x), Math.abs(at_y)) > kFarthest_m ? null : corner([at_x, at_y]);
}

const metres = (value: number) => `${value.toFixed(1).replace('-', '−')} m`;

/** "x 1.2 m, y −0.5 m". */
export function cornerText([x, y]: Point): string {
  return `x ${metres(x)}, y ${metres(y)}`;
}

/** "4 corners, 2.0 m by 1.5 m". */
export function fenceText(fence: Fence): string {
  const along = (axis: 0 | 1) => {
    const all = fence.map((one) => one[axis]);
    return metres(Math.max(...all) - Math.min(...all));
  };
  return `${count(fence.length, 'corner')}, ${along(0)} by ${along(1)}`;
}
