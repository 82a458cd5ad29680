// SPDX-License-Identifier: Apache-2.0
import type { PlanPose } from '../api/types';

/** What the walls of the building's plan say of where a chair is, for whoever cares for its rider. */
export interface PlanSays {
  words: string;
  disagrees: boolean; // with where the chair believes to be
}

/** `believed` completes "the chair is ...": "in the kitchen"; null: it does not know, or there are no words for it. */
export function planSays(pose: PlanPose, believed: string | null): PlanSays {
  const agrees = (words: string): PlanSays => ({ words, disagrees: false });
  switch (pose.lost) {
    case 'searching':
      return agrees('Not found on the plan yet. It is found once the camera has seen more walls.');
    case 'ambiguous':
      return agrees('Not found on the plan yet: several places on it look alike.');
    case 'not_in_plan':
      return agrees('Not found on the plan: the camera sees other walls than the plan has.');
    default:
  }
  if (pose.word === 'impossible')
    return {
      words: `The plan disagrees: by its walls the chair is not ${believed ?? 'where it believes to be'}. The arrow shows where the plan has it.`,
      disagrees: true,
    };
  return pose.word === 'possible'
    ? agrees('The walls of the plan agree with where the chair believes to be.')
    : agrees('By the walls of the plan the chair is where the arrow is.');
}
