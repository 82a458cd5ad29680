// SPDX-License-Identifier: Apache-2.0
import type { PlanPose } from '../../api/types';
import { Notice } from '../../components/notice';
import { planSays } from '../../words/plan_pose';

/** What the plan says of where the chair is. That it disagrees is read out at once; all else changes too
 *  often for that. */
export function PlanOpinion({ pose, believed }: { pose: PlanPose; believed: string | null }) {
  const says = planSays(pose, believed);
  return says.disagrees ? (
    <Notice tone="warn">{says.words}</Notice>
  ) : (
    <p class="small" data-testid="plan-opinion">
      {says.words}
    </p>
  );
}
