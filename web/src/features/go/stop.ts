// SPDX-License-Identifier: Apache-2.0
import { signal } from '@preact/signals';
import * as calls from '../../api/calls';
import { asProblem, type ProblemError } from '../../api/problem';

export type StopState =
  | { kind: 'ready' }
  | { kind: 'sending'; tries: number }
  | { kind: 'sent'; at_ms: number }
  | { kind: 'failed'; reason: string };

export const stopState = signal<StopState>({ kind: 'ready' });

const kTries = 12;
const kPauseMs = 400;

/**
 * Asks until the server has answered: a stop that got lost on the way is sent again under the same key, `kTries` times.
 * Refusals that repeating cannot mend end it at once. Returns what to tell.
 */
export async function askToStop(
  ask: () => Promise<unknown>,
  pause: (ms: number) => Promise<void>,
  onTry: (tries: number) => void,
): Promise<ProblemError | null> {
  let last: ProblemError | null = null;
  for (let tries = 1; tries <= kTries; ++tries) {
    onTry(tries);
    try {
      await ask();
      return null;
    } catch (thrown) {
      last = asProblem(thrown);
      if (last.status >= 400 && last.status < 500 && last.status !== 429) return last;
    }
    await pause(kPauseMs);
  }
  return last;
}

let presses = 0;

export async function stop(robot: string): Promise<void> {
  const press = ++presses;
  const key = calls.randomId();
  const tell = (state: StopState) => {
    if (press === presses) stopState.value = state;
  };
  const problem = await askToStop(
    () => calls.stopRobot(robot, key),
    (ms) => new Promise((done) => setTimeout(done, ms)),
    (tries) => tell({ kind: 'sending', tries }),
  );
  tell(problem ? { kind: 'failed', reason: problem.message } : { kind: 'sent', at_ms: Date.now() });
}
