// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { PlanLines } from '../../api/types';
import { boundsOf, dotPath, pressedAt, viewBoxOf, wallPath, wayPath } from './plan_geometry';

const lines: PlanLines = {
  plan: 'plan1',
  version: 1,
  total: 2,
  segments: [
    { x1_m: 0, y1_m: 0, x2_m: 10, y2_m: 0 },
    { x1_m: 10, y1_m: 0, x2_m: 10, y2_m: 5 },
  ],
};

describe('a plan on paper', () => {
  it('shows all walls and all that is marked, with a margin', () => {
    const bounds = boundsOf(lines, [{ x_m: 4, y_m: -5 }]);
    expect(bounds).toEqual({ left_m: -0.4, right_m: 10.4, bottom_m: -5.4, top_m: 5.4 });
    expect(viewBoxOf(bounds)).toBe('-0.4 -5.4 10.8 10.8');
  });

  it('has a size also where there is nothing, or a point', () => {
    expect(viewBoxOf(boundsOf({ ...lines, segments: [] }, []))).toBe('0 -1 1 1');
    expect(viewBoxOf(boundsOf({ ...lines, segments: [] }, [{ x_m: 2, y_m: 2 }]))).toBe(
      '1.96 -2.04 0.08 0.08',
    );
  });

  it('is drawn with y upwards', () => {
    expect(wallPath(lines)).toBe('M0 0L10 0M10 0L10 -5');
    expect(
      wayPath([
        { x_m: 1, y_m: 2 },
        { x_m: 3, y_m: 2.5 },
      ]),
    ).toBe('M1 -2L3 -2.5');
    expect(dotPath([{ x_m: 1, y_m: 2 }])).toBe('M1 -2h0');
  });

  it('knows where it was pressed, to the centimetre', () => {
    const bounds = boundsOf(lines, []);
    expect(pressedAt(bounds, 0, 0)).toEqual({ x_m: bounds.left_m, y_m: bounds.top_m });
    expect(pressedAt(bounds, 0.5, 1)).toEqual({ x_m: 5, y_m: bounds.bottom_m });
    expect(pressedAt(bounds, 1 / 3, 1 / 3)).toEqual({ x_m: 3.2, y_m: 3.47 });
  });
});
