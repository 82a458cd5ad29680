// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { Exploration } from '../../api/types';
import { boundsOf, fitted, moved, onPlan, onScreen, scaleBar, zoomed } from './plan_view';

const size = { width: 400, height: 300 };
const exploration = {
  pose: { x_m: 4.2, y_m: 0, theta_rad: 0 },
  target: [5.5, -1.2],
  nodes: [
    [0, 0],
    [3, 2.5],
  ],
  fences: [],
} as unknown as Exploration;

describe('boundsOf', () => {
  it('holds the beginning, the way, the robot, its target and the floor, in whole metres', () => {
    expect(boundsOf(exploration, null)).toEqual({ left: 0, right: 6, bottom: -2, top: 3 });
    expect(boundsOf(exploration, { left: -1.5, right: 2, bottom: 0, top: 7.1 })).toEqual({
      left: -2,
      right: 6,
      bottom: -2,
      top: 8,
    });
    expect(boundsOf(null, null)).toEqual({ left: 0, right: 0, bottom: 0, top: 0 });
  });
});

describe('a view of the plan', () => {
  it('fits all in, y up', () => {
    const bounds = { left: -5, right: 15, bottom: 0, top: 10 };
    const view = fitted(bounds, size);
    const [left, top] = onScreen(view, size, [bounds.left, bounds.top]);
    const [right, bottom] = onScreen(view, size, [bounds.right, bounds.bottom]);
    expect(left).toBeCloseTo(24);
    expect(right).toBeCloseTo(376);
    expect(top).toBeGreaterThan(24);
    expect(bottom).toBeLessThan(276);
    expect(bottom).toBeGreaterThan(top);
  });

  it('shows a room at least where next to nothing is known', () => {
    expect(fitted(boundsOf(null, null), size).scale).toBeCloseTo((300 - 48) / 6);
  });

  it('leads from the screen to the plan and back', () => {
    const view = { x: 3, y: -2, scale: 40 };
    const point = onPlan(view, size, { x: 100, y: 250 });
    const [x, y] = onScreen(view, size, point);
    expect([x, y]).toEqual([100, 250]);
  });

  it('keeps what is under the hand when it grows, and follows it when it moves', () => {
    const view = { x: 3, y: -2, scale: 40 };
    const at = { x: 80, y: 40 };
    const before = onPlan(view, size, at);
    const [x, y] = onPlan(zoomed(view, 1.6, at, size), size, at);
    expect(x).toBeCloseTo(before[0]);
    expect(y).toBeCloseTo(before[1]);
    const [mx, my] = onPlan(moved(view, 25, -10), size, { x: at.x + 25, y: at.y - 10 });
    expect(mx).toBeCloseTo(before[0]);
    expect(my).toBeCloseTo(before[1]);
    expect(zoomed(view, 1e9, at, size).scale).toBe(400);
  });

  it('has a scale of a round length', () => {
    expect(scaleBar(40)).toEqual({ metres: 2, width_px: 80 });
    expect(scaleBar(1).metres).toBe(100);
  });
});
