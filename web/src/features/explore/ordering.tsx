// SPDX-License-Identifier: Apache-2.0
import { useState } from 'preact/hooks';
import type { ProblemError } from '../../api/problem';
import type { Robot } from '../../api/types';
import { LeasePrompt } from '../../components/lease_prompt';
import { Notice } from '../../components/notice';
import { useCommand } from '../../lib/command';
import { withLease } from '../go/driving';

type Order = (lease_id: string) => Promise<unknown>;

export interface Orders {
  busy: boolean;
  problem: ProblemError | null;
  held: Order | null; // what was not done because somebody else drives
  give: (order: Order) => void;
  takeOver: () => void;
  forget: () => void;
}

/** Orders to a robot that need its lease; somebody else's is taken only when that is meant. */
export function useOrders(robot: string): Orders {
  const { busy, problem, run, forget } = useCommand();
  const [last, setLast] = useState<Order | null>(null);
  const give = (order: Order, take_over = false) => {
    setLast(() => order);
    run(() => withLease(robot, order, take_over));
  };
  const held = problem?.code === 'lease_held' ? last : null;
  return {
    busy,
    problem: held ? null : problem,
    held,
    give: (order) => give(order),
    takeOver: () => {
      if (held) give(held, true);
    },
    forget,
  };
}

/** What became of an order: refused and why, or a question whether to take over from whoever drives. */
export function OrderNotice({ robot, orders }: { robot: Robot; orders: Orders }) {
  const { problem, held, takeOver, forget } = orders;
  if (problem) return <Notice tone="bad">{problem.message}</Notice>;
  if (!held) return null;
  return (
    <LeasePrompt
      holder={robot.lease?.holder}
      chair={robot.name}
      question="Take over?"
      onTakeOver={takeOver}
      onLeave={forget}
    />
  );
}
