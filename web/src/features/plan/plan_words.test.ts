// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { Graph, MapPlan, Robot } from '../../api/types';
import { chairPlace, chairWords, fitWords, marksOf, sizeWords, wayOn } from './plan_words';

const place = (id: string, label: string) => ({
  id,
  label,
  prototype: `t1/${id}.jpg`,
  members: [`t1/${id}.jpg`],
  features: 0,
  x: 0,
  y: 0,
});
const graph: Graph = {
  format: 'homeward-graph',
  version: 1,
  map: 'm1',
  revision: 1,
  places: [place('p1', 'hall'), place('p2', ''), place('p5', 'kitchen'), place('p13', '')],
  edges: [],
  destinations: [],
  hypotheses: [],
  shortcuts: [],
} as unknown as Graph;
const tie: MapPlan = {
  map: 'm1',
  revision: 1,
  plan: 'plan1',
  version: 1,
  newest_version: 1,
  tied_us: 5,
  by: 'anna',
  pins: [],
  rms_m: 0.314,
  places: [
    { place: 'p1', x_m: 1, y_m: 2, theta_rad: 0, pinned: true, residual_m: 0.3 },
    { place: 'p2', x_m: 3, y_m: 2, theta_rad: 0, pinned: false, residual_m: null },
    { place: 'p5', x_m: 5, y_m: 6, theta_rad: 0, pinned: false, residual_m: null },
  ],
  unplaced: ['p13'],
};
const robot = {
  online: true,
  belief: { updates: 3, place: 'p1', probability: 0.9, top: [], lost: false },
} as unknown as Robot;

describe('what a plan shows', () => {
  it('marks places, the chair and where it goes', () => {
    const marks = marksOf(tie, graph, 'p1', 'p5');
    expect(marks.map(({ key, kind, label }) => [key, kind, label])).toEqual([
      ['p1', 'pinned', ''],
      ['p2', 'place', ''],
      ['p5', 'place', ''],
      ['goal', 'goal', 'Kitchen'],
      ['chair', 'chair', 'Hall'],
    ]);
    expect(marks.at(-1)).toMatchObject({ x_m: 1, y_m: 2 });
    expect(marksOf(tie, graph, null, null)[2]?.label).toBe('Kitchen');
    expect(marksOf(tie, graph, 'p13', null)).toHaveLength(3);
  });

  it('draws a way as far as its places are known', () => {
    expect(wayOn(tie, ['p1', 'p13', 'p5']).map((one) => one.x_m)).toEqual([1, 5]);
  });

  it('is told in words', () => {
    expect(chairWords(robot, graph, tie, null)).toBe('The chair is in the hall.');
    expect(chairWords(robot, graph, tie, 'p5')).toBe('The chair is in the hall. It goes to Kitchen.');
    const at = (place: string) => ({ ...robot, belief: { ...robot.belief, place } }) as Robot;
    expect(chairWords(at('p13'), graph, tie, null)).toContain('not on the plan');
    const lost = { ...robot, belief: { ...robot.belief, lost: true } } as Robot;
    expect([chairPlace(lost), chairPlace(null), chairPlace({ ...robot, online: false })]).toEqual([
      null,
      null,
      null,
    ]);
    expect(chairWords(lost, graph, tie, null)).toContain('not known');
  });

  it('says how well the map lies on it', () => {
    expect(fitWords(tie)).toContain('0.31 m off');
    expect(fitWords(tie)).toContain('1 place of parts without two pins is not');
    expect(fitWords({ ...tie, unplaced: [] })).not.toContain('parts');
    expect(fitWords({ ...tie, rms_m: null })).toContain('Pin two places again');
  });

  it('says how large it is', () => {
    const extent = { min_x_m: -1, min_y_m: 0, min_z_m: 0, max_x_m: 13.25, max_y_m: 9.5, max_z_m: 2 };
    const version = {
      version: 1,
      format: 'svg',
      created_us: 1,
      by: 'anna',
      bytes: 1,
      metres_per_unit: 1,
      up: null,
    };
    expect(sizeWords({ ...version, wall_height_m: 2.5, lines: 812, triangles: 0, extent })).toBe(
      '14 m by 9.50 m, 812 lines',
    );
  });
});
