// SPDX-License-Identifier: Apache-2.0
import * as calls from '../../api/calls';
import type { ProblemError } from '../../api/problem';
import { Notice } from '../../components/notice';

/** What became of the latest change: what it did, or why it could not be made. Both null: it is under way. */
export interface OutcomeOf {
  done: string | null;
  problem: ProblemError | null;
  map: string;
  pictures: readonly string[]; // that a refusal is about
}

/** Said beside the button that was pressed. */
export function Outcome({ of }: { of: OutcomeOf }) {
  if (!of.problem) return of.done === null ? null : <Notice>{of.done}</Notice>;
  return (
    <Notice tone="bad">
      <p>{of.problem.message}</p>
      {of.pictures.length > 0 && (
        <ul class="concerned">
          {of.pictures.map((image) => (
            <li key={image}>
              <img
                src={calls.imageThumbnailUrl(of.map, image)}
                alt={`Picture ${image.split('/').at(-1) ?? image}`}
              />
            </li>
          ))}
        </ul>
      )}
    </Notice>
  );
}
