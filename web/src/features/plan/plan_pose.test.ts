// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { MapInfo, PlanPose, Robot } from '../../api/types';
import { arrowOf, poseOn } from './plan_pose';

const map = { id: 'm1', plan: { id: 'plan1', version: 2, tied_us: 7 } } as unknown as MapInfo;
const robot = { id: 'r1', online: true, map: 'm1' } as unknown as Robot;
const pose = {
  robot: 'r1',
  map: 'm1',
  plan: 'plan1',
  version: 2,
  tied_us: 7,
  x_m: 1,
  y_m: 2,
  theta_rad: 0.5,
} as unknown as PlanPose;
const heard = (part: Partial<PlanPose> = {}) => ({ r1: { pose: { ...pose, ...part }, heard_ms: 1000 } });

describe('where a robot is on the plan of its map', () => {
  it('is what was told last of this robot, map and tie', () => {
    expect(poseOn(map, robot, heard(), 1500)).toMatchObject({ x_m: 1 });
    for (const other of [{ map: 'm2' }, { plan: 'plan2' }, { version: 1 }, { tied_us: 6 }])
      expect(poseOn(map, robot, heard(other), 1500)).toBeNull();
    expect(poseOn({ ...map, plan: null }, robot, heard(), 1500)).toBeNull();
  });

  it('is not known of one that is gone, is elsewhere, or was not told of for a while', () => {
    expect(poseOn(map, null, heard(), 1500)).toBeNull();
    expect(poseOn(map, { ...robot, online: false }, heard(), 1500)).toBeNull();
    expect(poseOn(map, { ...robot, map: 'm2' }, heard(), 1500)).toBeNull();
    expect(poseOn(map, { ...robot, id: 'r2' }, heard(), 1500)).toBeNull();
    expect(poseOn(map, robot, heard(), 6000)).not.toBeNull();
    expect(poseOn(map, robot, heard(), 6001)).toBeNull();
  });

  it('has an arrow unless it is lost', () => {
    expect(arrowOf(pose)).toEqual({ x_m: 1, y_m: 2, theta_rad: 0.5 });
    expect(arrowOf({ ...pose, x_m: null, y_m: null, theta_rad: null })).toBeNull();
  });
});
