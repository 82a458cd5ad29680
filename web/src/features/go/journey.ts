// SPDX-License-Identifier: Apache-2.0
import type { Mission, Reason, Robot } from '../../api/types';

/** What this page last asked of a robot, until the robot's mission tells the rest. */
export type Command =
  | { kind: 'asking'; target: Target }
  | { kind: 'held'; target: Target; holder: string | null }
  | { kind: 'diversion'; target: Target } // it is under way to somewhere else: whoever asked has to say so again
  | { kind: 'refused'; target: Target; reason: string }
  | { kind: 'sent'; target: Target; mission: Mission };

export interface Target {
  destination?: string;
  place?: string;
  label: string;
}

export type Phase = 'asking' | 'accepted' | 'driving' | 'arrived' | 'refused' | 'stopped' | 'failed';

/** The journey to show: the newest command, and how far it has come. */
export interface Journey {
  id: string | null; // the mission's; null before there is one
  phase: Phase;
  explores: boolean; // it leads nowhere: the robot maps the building by itself
  destination: string | null;
  place: string | null;
  reason: Reason | null; // as the mission tells it
  refusal: string | null; // what the server answered instead of a mission
  by: string | null;
  created_us: number | null;
  ended_us: number | null; // null: it has not, or nobody knows when
  path: readonly string[];
  path_index: number;
  arrival_probability: number | null; // what the robot states of being there
}

export function isActive(phase: Phase | undefined): boolean {
  return phase === 'accepted' || phase === 'driving';
}

export function journeyOf(robot: Robot, command: Command | undefined): Journey | null {
  if (command?.kind === 'asking' || command?.kind === 'refused') {
    return {
      id: null,
      phase: command.kind,
      explores: false,
      destination: command.target.destination ?? null,
      place: command.target.place ?? null,
      reason: null,
      refusal: command.kind === 'refused' ? command.reason : null,
      by: null,
      created_us: null,
      ended_us: null,
      path: [],
      path_index: 0,
      arrival_probability: null,
    };
  }
  const mission = newest(robot.mission, command?.kind === 'sent' ? command.mission : null);
  if (!mission) return null;
  return {
    id: mission.id,
    phase: mission.state,
    explores: mission.kind === 'explore',
    destination: mission.destination,
    place: mission.place,
    reason: mission.reason,
    refusal: null,
    by: mission.by,
    created_us: mission.created_us,
    ended_us: mission.ended_us,
    path: mission.path,
    path_index: Math.min(Math.max(0, mission.path_index), Math.max(0, mission.path.length - 1)),
    arrival_probability: mission.arrival_probability,
  };
}

/** Whether a journey leads where somebody wants to go. */
export function leadsThere(journey: Journey, target: Target): boolean {
  return target.destination === undefined
    ? journey.destination === null && journey.place === target.place
    : journey.destination === target.destination;
}

/**
 * What a wish to go somewhere is to a robot on this journey: a new drive, nothing new, or another way than the one it is
 * on, which riders beside it may count on.
 */
export function wishOf(journey: Journey | null, target: Target): 'new' | 'same' | 'diversion' {
  if (!journey || !(isActive(journey.phase) || journey.phase === 'asking')) return 'new';
  return leadsThere(journey, target) ? 'same' : 'diversion';
}

/** The robot's word counts for the same mission; of two missions the later one. */
function newest(reported: Mission | null, sent: Mission | null): Mission | null {
  if (!reported || !sent) return reported ?? sent;
  return reported.id !== sent.id && sent.created_us > reported.created_us ? sent : reported;
}

/** How many places are still ahead; the robot drives to the one at path_index. */
export function placesToGo(journey: Journey): number {
  if (journey.phase === 'arrived') return 0;
  return Math.max(0, journey.path.length - Math.max(1, journey.path_index));
}

/** Share of the way that is done, 0 to 1. */
export function progressOf(journey: Journey): number {
  if (journey.phase === 'arrived') return 1;
  const steps = journey.path.length - 1;
  return steps < 1 ? 0 : 1 - placesToGo(journey) / steps;
}

/** Whether the robot is under way by itself, to map the building. */
export function exploresNow({ mission }: Robot): boolean {
  return mission?.kind === 'explore' && isActive(mission.state);
}

/** Why the robot cannot be sent anywhere just now; null when it can. */
export function hindrance(robot: Robot, connected: boolean, mayDrive: boolean): string | null {
  if (!mayDrive) return 'Your account may look and may stop the chair, but not send it.';
  if (!connected) return 'The house server is out of reach, so the chair cannot be sent.';
  if (!robot.online) return `${robot.name} is not connected, so it cannot be sent.`;
  if (exploresNow(robot)) return `${robot.name} maps the building by itself. Stop it before you send it.`;
  if (robot.map === null) return `${robot.name} has no map yet. Give it one under Robots.`;
  return null;
}
