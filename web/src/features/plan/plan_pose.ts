// SPDX-License-Identifier: Apache-2.0
import type { HeardPose } from '../../api/server_state';
import type { MapInfo, PlanPose, Robot } from '../../api/types';

const kFresh_ms = 5000; // a robot is told of twice a second while it sends pictures

/** Where a robot is on the plan of `map`, of now: null where it is not followed there, or was told of on another tie. */
export function poseOn(
  map: MapInfo,
  robot: Robot | null,
  heard: Readonly<Record<string, HeardPose>>,
  now_ms: number,
): PlanPose | null {
  const told = robot?.online && robot.map === map.id ? heard[robot.id] : undefined;
  if (!told || !map.plan || now_ms - told.heard_ms > kFresh_ms) return null;
  const { pose } = told;
  const { id, version, tied_us } = map.plan;
  const same =
    pose.map === map.id && pose.plan === id && pose.version === version && pose.tied_us === tied_us;
  return same ? pose : null;
}

/** The spot and heading of the arrow; null while it is lost. */
export function arrowOf(pose: PlanPose): { x_m: number; y_m: number; theta_rad: number } | null {
  const { x_m, y_m, theta_rad } = pose;
  return x_m === null || y_m === null || theta_rad === null ? null : { x_m, y_m, theta_rad };
}
