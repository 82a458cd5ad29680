// SPDX-License-Identifier: Apache-2.0
import { useState } from 'preact/hooks';
import { me } from '../../api/server';
import type { ProblemError } from '../../api/problem';
import type { Robot } from '../../api/types';
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
  const holder = robot.lease?.holder;
  const who = !holder || holder === me.value?.name ? 'Somebody else' : holder;
  return (
    <Notice tone="warn">
      <div class="stack">
        <p role="alert">
          <strong>
            {who} is driving {robot.name} just now.
          </strong>{' '}
          Take over?
        </p>
        <div class="row">
          <button type="button" class="button main" onClick={takeOver}>
            Take over
          </button>
          <button type="button" class="button" onClick={forget}>
            Leave it to {who}
          </button>
        </div>
      </div>
    </Notice>
  );
}
