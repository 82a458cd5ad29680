// SPDX-License-Identifier: Apache-2.0
import type { DriveState, Robot } from '../../api/types';
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
