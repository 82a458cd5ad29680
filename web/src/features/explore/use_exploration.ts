// SPDX-License-Identifier: Apache-2.0
import { useEffect, useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import { asProblem, type ProblemError } from '../../api/problem';
import { connection } from '../../api/server';
import type { Exploration } from '../../api/types';

interface Asked {
  robot: string;
  value: Exploration | null;
  problem: ProblemError | null;
}

export interface ExplorationHandle {
  exploration: Exploration | null; // null: none, or not known yet
  known: boolean;
  problem: ProblemError | null;
}

/** The exploration of a robot: as the events tell, and as the server answers when the page or the connection begins. */
export function useExploration(robot: string): ExplorationHandle {
  const { server } = connection.value;
  const since = server?.since;
  const [asked, setAsked] = useState<Asked | null>(null);
  useEffect(() => {
    let wanted = true;
    const answer = (value: Exploration | null, problem: ProblemError | null) => {
      if (wanted) setAsked({ robot, value, problem });
    };
    calls.exploration(robot).then(
      (value) => answer(value, null),
      (thrown: unknown) => {
        const problem = asProblem(thrown);
        answer(null, problem.status === 404 ? null : problem);
      },
    );
    return () => {
      wanted = false;
    };
  }, [robot, since]);
  const told = server?.explorations[robot];
  if (told) return { exploration: told, known: true, problem: null };
  if (asked?.robot !== robot) return { exploration: null, known: false, problem: null };
  return { exploration: asked.value, known: true, problem: asked.problem };
}
