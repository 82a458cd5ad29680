// SPDX-License-Identifier: Apache-2.0
import { useCallback, useEffect, useState } from 'preact/hooks';
import { asProblem, type ProblemError } from '../api/problem';

export interface Loaded<T> {
  value: T | null;
  problem: ProblemError | null;
  again: () => void;
}

/**
 * What `ask` answers, asked on the first showing, whenever `again` is called and when what it tells of has another
 * `version`; the old value stays meanwhile.
 */
export function useLoaded<T>(ask: () => Promise<T>, version = 0): Loaded<T> {
  const [value, setValue] = useState<T | null>(null);
  const [problem, setProblem] = useState<ProblemError | null>(null);
  const [round, setRound] = useState(0);
  useEffect(() => {
    let wanted = true;
    ask().then(
      (answer) => {
        if (!wanted) return;
        setValue(answer);
        setProblem(null);
      },
      (thrown: unknown) => {
        if (wanted) setProblem(asProblem(thrown));
      },
    );
    return () => {
      wanted = false;
    };
    // `ask` is one of the functions of api/calls; a new closure of it is no reason to ask again.
    // eslint-disable-next-line react-hooks/exhaustive-deps
  }, [round, version]);
  return { value, problem, again: useCallback(() => setRound((n) => n + 1), []) };
}
