// SPDX-License-Identifier: Apache-2.0
import * as calls from '../../api/calls';
import type { Robot } from '../../api/types';
import { Notice } from '../../components/notice';
import { LivePicture } from '../robots/live_picture';
import { forgetCommand } from '../go/driving';
import { LimitFields, useLimits } from './limits';
import { OrderNotice, useOrders } from './ordering';

interface Props {
  robot: Robot;
  barrier: string | null; // why it cannot be sent now
  mayOrder: boolean;
}

/** What will happen and what a person has to do, and the start of it. */
export function Intro({ robot, barrier, mayOrder }: Props) {
  return (
    <div class="two-columns">
      <Advice name={robot.name} />
      <div class="stack">
        {mayOrder ? (
          <Start robot={robot} barrier={barrier} />
        ) : (
          <Notice still>
            Somebody who may install things starts it. You may watch, and you may stop it.
          </Notice>
        )}
        <section class="card" aria-label={`Camera of ${robot.name}`}>
          <LivePicture robot={robot} />
        </section>
      </div>
    </div>
  );
}

function Start({ robot, barrier }: { robot: Robot; barrier: string | null }) {
  const limits = useLimits();
  const orders = useOrders(robot.id);
  const submit = (event: Event) => {
    event.preventDefault();
    const { limits: wanted } = limits;
    if (!wanted) return;
    forgetCommand(robot.id); // what Go asked of it before is over
    orders.give((lease_id) => calls.explore(robot.id, { ...wanted, lease_id }));
  };
  return (
    <form class="card stack" aria-labelledby="explore-start" onSubmit={submit}>
      <h2 id="explore-start">Start here</h2>
      <p class="soft">
        {robot.name} begins where it stands now, and calls that place its beginning. Limits may stay empty.
      </p>
      <LimitFields {...limits} />
      {barrier !== null && (
        <Notice tone="warn" still>
          {barrier}
        </Notice>
      )}
      <OrderNotice robot={robot} orders={orders} />
      <div class="row">
        <button
          type="submit"
          class="button main"
          disabled={orders.busy || barrier !== null || limits.limits === null}
        >
          {orders.busy ? 'Starting …' : `Start: ${robot.name} maps the building`}
        </button>
      </div>
    </form>
  );
}

function Advice({ name }: { name: string }) {
  return (
    <section class="card stack" aria-labelledby="explore-what">
      <h2 id="explore-what">What will happen</h2>
      <ul class="bullets">
        <li>
          {name} drives by itself through all rooms that it can get to, and takes pictures. It needs no map
          for that.
        </li>
        <li>You see here what it has seen. You can pause it at any time, and let it go on.</li>
        <li>When it is over, its pictures become a tour on the server. A map is built from tours.</li>
      </ul>
      <h2>What you have to do</h2>
      <ul class="bullets">
        <li>
          <strong>Walk with it and watch it</strong> all the time. STOP always works, and so does the stop
          button on {name} itself.
        </li>
        <li>
          <strong>Close off stairs.</strong> Its laser sees neither stairs that lead down nor the edges of
          tables. Shut the doors to them or block the way; you can also draw fences on the plan.
        </li>
        <li>Open the doors of the rooms that it is to see.</li>
        <li>Keep this page open: when it is closed, {name} stops.</li>
      </ul>
    </section>
  );
}
