// SPDX-License-Identifier: Apache-2.0
import type { ProblemError } from '../../api/problem';
import { Notice } from '../../components/notice';

/** What became of the latest change: what it did, or why it could not be made. Both null: it is under way. */
export interface OutcomeOf {
  done: string | null;
  problem: ProblemError | null;
}

/** Said beside the button that was pressed. */
export function Outcome({ of }: { of: OutcomeOf }) {
  if (of.problem) return <Notice tone="bad">{of.problem.message}</Notice>;
  return of.done === null ? null : <Notice>{of.done}</Notice>;
}
