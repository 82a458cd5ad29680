// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { PlanPose } from '../api/types';
import { planSays } from './plan_pose';

const pose = (part: Partial<PlanPose>) => ({ lost: null, word: 'silent', ...part }) as PlanPose;

describe('what the walls of the plan say', () => {
  it('is that it disagrees, with the place, where that is impossible', () => {
    const says = planSays(pose({ word: 'impossible' }), 'in the kitchen');
    expect(says.disagrees).toBe(true);
    expect(says.words).toMatch(/^The plan disagrees: by its walls the chair is not in the kitchen\./);
    expect(planSays(pose({ word: 'impossible' }), null).words).toContain('not where it believes to be.');
  });

  it('is that it was not found yet while it is looked for, whatever was said before', () => {
    for (const lost of ['searching', 'ambiguous', 'not_in_plan'] as const) {
      const says = planSays(pose({ lost, word: 'impossible' }), 'in the kitchen');
      expect([says.disagrees, says.words.startsWith('Not found on the plan')]).toEqual([false, true]);
    }
    expect(planSays(pose({ lost: 'ambiguous' }), null).words).toContain('look alike');
  });

  it('is that it agrees only where it says so', () => {
    expect(planSays(pose({ word: 'possible' }), null).words).toContain('agree');
    expect(planSays(pose({}), null).words).not.toContain('agree');
  });
});
