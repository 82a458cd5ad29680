// SPDX-License-Identifier: Apache-2.0
import type { DriveState, Robot } from '../../api/types';
import { timeText } from '../../lib/words';
import { reasonSentence } from '../../words/reasons';

const kStates: Readonly<Record<DriveState, string>> = {
  idle: 'Standing',
  driving: 'Driving',
  arrived: 'Arrived',
  stopped: 'Stopped',
  failed: 'Gave up',
};

/** What the robot does, in a word or two. */
export function stateWord(robot: Robot): string {
  if (!robot.online) return 'Not connected';
  return robot.state === null ? 'Connected' : kStates[robot.state];
}

export function stateTone(robot: Robot): 'good' | 'warn' | 'bad' {
  if (!robot.online || robot.state === 'failed') return 'bad';
  return robot.state === 'stopped' ? 'warn' : 'good';
}

/** Why it stopped or gave up, as a sentence; null when there is nothing to explain. */
export function whyStopped(robot: Robot): string | null {
  if (robot.state !== 'stopped' && robot.state !== 'failed') return null;
  const reason = robot.reason ?? robot.mission?.reason ?? null;
  return reason === null ? null : reasonSentence(reason);
}

/** When that was, as a sentence; null where it is not known, or where something else than its last drive was stopped. */
export function endOf(robot: Robot, now_ms: number): string | null {
  const { reason = null, mission } = robot;
  if (whyStopped(robot) === null || mission === null || mission.ended_us === null) return null;
  const same = reason === null || JSON.stringify(reason) === JSON.stringify(mission.reason);
  return same ? `That was at ${timeText(mission.ended_us, now_ms)}.` : null;
}

/** A direction as people say it; angles are counter-clockwise from ahead. */
export function directionWord(bearing_rad: number): string {
  const eighth = Math.round((bearing_rad * 4) / Math.PI);
  return (
    [
      'ahead',
      'ahead to the left',
      'left',
      'behind to the left',
      'behind',
      'behind to the right',
      'right',
      'ahead to the right',
    ][((eighth % 8) + 8) % 8] ?? 'ahead'
  );
}
