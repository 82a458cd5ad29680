// SPDX-License-Identifier: Apache-2.0
import type { ComponentChildren } from 'preact';
import type { Loaded } from '../lib/loaded';
import { Notice, Waiting } from './notice';

/** Shows what was loaded; meanwhile that it is on its way, and what went wrong with a way to try again. */
export function Loading<T>(props: {
  of: Loaded<T>;
  what: string;
  children: (value: T) => ComponentChildren;
}) {
  const { value, problem, again } = props.of;
  return (
    <>
      {problem && (
        <Notice tone="bad">
          <div class="row apart">
            <span>
              {props.what} could not be loaded. {problem.message}
            </span>
            <button type="button" class="button" onClick={again}>
              Try again
            </button>
          </div>
        </Notice>
      )}
      {value === null
        ? !problem && <Waiting what={`Loading ${props.what.toLowerCase()} …`} />
        : props.children(value)}
    </>
  );
}
