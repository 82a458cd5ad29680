// SPDX-License-Identifier: Apache-2.0
import type { Exploration } from '../../api/types';
import type { Bounds } from './floor';

/** Metres of the exploration's own frame; y is up. */
export type Point = readonly [x: number, y: number];

export interface Size {
  width: number;
  height: number;
}

/** What of the plan is in view: the point in the middle, and pixels per metre. */
export interface PlanView {
  x: number;
  y: number;
  scale: number;
}

const kMargin_px = 24;
const kLeast_m = 6; // a room at least, so that the first pictures are no blots
const kScales = { least: 0.5, most: 400 };

const inRange = (scale: number) => Math.min(kScales.most, Math.max(kScales.least, scale));

/** Around everything that there is to see, in whole metres, so that a plan that grows does not move each second. */
export function boundsOf(of: Exploration | null, known: Bounds | null): Bounds {
  const { pose = null, target = null, nodes = [], fences = [] } = of ?? {};
  const points: number[][] = [[0, 0], ...nodes, ...fences.flat()];
  if (pose) points.push([pose.x_m, pose.y_m]);
  if (target) points.push(target);
  if (known) points.push([known.left, known.bottom], [known.right, known.top]);
  const all = { left: Infinity, right: -Infinity, bottom: Infinity, top: -Infinity };
  for (const [x = 0, y = 0] of points) {
    all.left = Math.min(all.left, Math.floor(x));
    all.right = Math.max(all.right, Math.ceil(x));
    all.bottom = Math.min(all.bottom, Math.floor(y));
    all.top = Math.max(all.top, Math.ceil(y));
  }
  return all;
}

/** Shows all of `bounds` in the middle. */
export function fitted({ left, right, bottom, top }: Bounds, { width, height }: Size): PlanView {
  const wide = Math.max(kLeast_m, right - left);
  const high = Math.max(kLeast_m, top - bottom);
  const scale = Math.min((width - 2 * kMargin_px) / wide, (height - 2 * kMargin_px) / high);
  return { x: (left + right) / 2, y: (bottom + top) / 2, scale: inRange(scale) };
}

/** Where a point of the plan is on the screen, from the upper left corner of the drawing. */
export function onScreen(view: PlanView, { width, height }: Size, [x, y]: Point): [number, number] {
  return [width / 2 + (x - view.x) * view.scale, height / 2 - (y - view.y) * view.scale];
}

/** What of the plan is at a point of the screen. */
export function onPlan(view: PlanView, { width, height }: Size, at: { x: number; y: number }): Point {
  return [view.x + (at.x - width / 2) / view.scale, view.y - (at.y - height / 2) / view.scale];
}

/** Moves the plan by so many pixels. */
export function moved(view: PlanView, dx: number, dy: number): PlanView {
  return { ...view, x: view.x - dx / view.scale, y: view.y + dy / view.scale };
}

/** Grows or shrinks the plan; what is at `at` stays there. */
export function zoomed(view: PlanView, factor: number, at: { x: number; y: number }, size: Size): PlanView {
  const scale = inRange(view.scale * factor);
  const [x, y] = onPlan(view, size, at);
  return {
    scale,
    x: x - (at.x - size.width / 2) / scale,
    y: y + (at.y - size.height / 2) / scale,
  };
}

/** A length that is a round number of metres and takes some 60 to 150 pixels, for a scale beside the plan. */
export function scaleBar(scale: number): { metres: number; width_px: number } {
  const lengths = [0.5, 1, 2, 5, 10, 20, 50, 100, 200];
  const metres = lengths.find((one) => one * scale >= 60) ?? 200;
  return { metres, width_px: metres * scale };
}
