// SPDX-License-Identifier: Apache-2.0
import type { Mission, Robot } from '../../api/types';
import { withArticle } from '../../lib/whereabouts';
import { inSentence } from '../../lib/words';

/** Whether this is the destination, as a robot asks the people beside it. */
export interface Question {
  mission: string;
  number: number;
  label: string; // of the destination; may be empty
  left_s: number;
}

/** What the robot asks and an answer may go to; null: nothing, or somebody has answered. */
export function questionOf(robot: Robot): Question | null {
  const { question, mission } = robot;
  if (!robot.online || !question || !isUnderWay(mission)) return null;
  return {
    mission: mission.id,
    number: question.number,
    label: question.label,
    left_s: question.left_s,
  };
}

function isUnderWay(mission: Mission | null): mission is Mission {
  return mission?.state === 'accepted' || mission?.state === 'driving';
}

/** "Is this the south hall?" */
export function questionWords(question: Question): string {
  const label = inSentence(question.label);
  return label === '' ? 'Is this the place that you chose?' : `Is this ${withArticle(label)}?`;
}

/** How long it still waits, in steps that a person can read; `age_ms`: since the robot was last heard of. */
export function waitWords(question: Question, age_ms: number): string {
  const left_s = question.left_s - age_ms / 1000;
  if (left_s <= 1) return 'I give up waiting in a moment.';
  return `I stand here and wait for an answer, ${Math.ceil(left_s)} s more.`;
}
