// SPDX-License-Identifier: Apache-2.0
import { useRef, useState } from 'preact/hooks';
import { asProblem, type ProblemError } from '../api/problem';

export interface CommandHandle {
  busy: boolean;
  problem: ProblemError | null;
  /** Does `work` unless one is under way already; what goes wrong becomes `problem`. */
  run: (work: () => Promise<unknown>) => void;
  forget: () => void;
}

/** The state of a command that a form or button gives. */
export function useCommand(): CommandHandle {
  const [busy, setBusy] = useState(false);
  const [problem, setProblem] = useState<ProblemError | null>(null);
  const running = useRef(false);
  const run = (work: () => Promise<unknown>) => {
    if (running.current) return;
    running.current = true;
    setBusy(true);
    setProblem(null);
    work()
      .catch((thrown: unknown) => setProblem(asProblem(thrown)))
      .finally(() => {
        running.current = false;
        setBusy(false);
      });
  };
  return { busy, problem, run, forget: () => setProblem(null) };
}
