// SPDX-License-Identifier: Apache-2.0
import type { Draft, Exploration, ServerEvent, Job, MapInfo, PlanPose, Robot } from './types';

/** Everything that the events tell, with when each robot was last heard of (this browser's clock). */
export interface ServerState {
  readonly seq: number;
  readonly build: string;
  readonly robots: readonly Robot[];
  readonly jobs: readonly Job[];
  readonly maps: readonly MapInfo[];
  readonly heard_ms: Readonly<Record<string, number>>;
  readonly since: number; // the number of the snapshot
  readonly drafts: Readonly<Record<string, Draft | null>>; // those that changed since the snapshot; null: gone
  readonly explorations: Readonly<Record<string, Exploration>>; // of each robot the newest since the snapshot
  readonly plan_poses: Readonly<Record<string, HeardPose>>; // the same
}

/** Where a robot is on a plan, and when that was heard (this browser's clock). */
export interface HeardPose {
  readonly pose: PlanPose;
  readonly heard_ms: number;
}

/**
 * What an event makes of the state; 'gap' when the snapshot must be asked for. Each change tells its thing whole, and a slow
 * reader gets only the newest of each, so numbers may be left out; what is older than the snapshot is in it already.
 */
export function applyEvent(
  state: ServerState | null,
  event: ServerEvent,
  now_ms: number,
): ServerState | 'gap' {
  if (event.type === 'snapshot') {
    return {
      seq: event.seq,
      build: event.build,
      robots: event.robots,
      jobs: event.jobs,
      maps: event.maps,
      heard_ms: Object.fromEntries(event.robots.map((robot) => [robot.id, now_ms])),
      since: event.seq,
      drafts: {},
      explorations: {},
      plan_poses: {},
    };
  }
  if (state === null) return 'gap';
  if (event.seq <= state.seq) return state;
  const next = { ...state, seq: event.seq };
  switch (event.type) {
    case 'robot':
      return {
        ...next,
        robots: withChanged(state.robots, event.robot),
        heard_ms: { ...state.heard_ms, [event.robot.id]: now_ms },
      };
    case 'job':
      return { ...next, jobs: withChanged(state.jobs, event.job) };
    case 'map':
      return { ...next, maps: withChanged(state.maps, event.map) };
    case 'mission':
      return { ...next, robots: state.robots.map((robot) => withMission(robot, event.mission)) };
    case 'draft':
      return { ...next, drafts: { ...state.drafts, [event.draft.id]: event.draft } };
    case 'draft_gone':
      return { ...next, drafts: { ...state.drafts, [event.draft]: null } };
    case 'exploration':
      return { ...next, explorations: { ...state.explorations, [event.robot]: event.exploration } };
    case 'plan_pose':
      return {
        ...next,
        plan_poses: { ...state.plan_poses, [event.pose.robot]: { pose: event.pose, heard_ms: now_ms } },
      };
    case 'heartbeat':
      return next;
    default:
      return next; // a kind that this version does not know: counted, not shown
  }
}

function withMission(robot: Robot, mission: NonNullable<Robot['mission']>): Robot {
  if (robot.id !== mission.robot) return robot;
  // A late word about an earlier mission must not replace the present one.
  if (robot.mission && robot.mission.id !== mission.id && robot.mission.created_us > mission.created_us)
    return robot;
  return { ...robot, mission };
}

function withChanged<T extends { id: string }>(list: readonly T[], changed: T): readonly T[] {
  return list.some((item) => item.id === changed.id)
    ? list.map((item) => (item.id === changed.id ? changed : item))
    : [...list, changed];
}

/** How old the newest status of a robot is, in milliseconds; null when nothing was ever heard. */
export function statusAgeMs(robot: Robot, heard_ms: number | undefined, now_ms: number): number | null {
  if (robot.status_age_ms === null || heard_ms === undefined) return null;
  return Math.max(0, robot.status_age_ms + (now_ms - heard_ms));
}
