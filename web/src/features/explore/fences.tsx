// SPDX-License-Identifier: Apache-2.0
import { useEffect, useRef, useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import type { Exploration, Robot } from '../../api/types';
import { TextField } from '../../components/field';
import { Notice } from '../../components/notice';
import { SureButton } from '../../components/sure_button';
import { count } from '../../lib/words';
import {
  corner,
  cornerText,
  fenceText,
  fencesOf,
  kLeastCorners,
  kMostCorners,
  sameFences,
  told,
  typedCorner,
  type Fence,
} from './fence_words';
import { OrderNotice, useOrders, type Orders } from './ordering';
import type { Point } from './plan_view';

export interface FencesHandle {
  fences: readonly Fence[]; // as they are, or as they will be once the robot has heard
  unheard: boolean; // sent, and the robot has not said yet that it knows them
  drawn: readonly Point[] | null;
  draw: (corners: readonly Point[] | null) => void;
  add: (at: Point) => void;
  set: (fences: readonly Fence[]) => void;
  orders: Orders;
}

export function useFences(robot: Robot, exploration: Exploration | null): FencesHandle {
  const orders = useOrders(robot.id);
  const [drawn, draw] = useState<readonly Point[] | null>(null);
  const [sent, setSent] = useState<{ fences: readonly Fence[]; base: readonly Fence[] } | null>(null);
  const now = fencesOf(exploration?.fences ?? []);
  const unheard = sent !== null && sameFences(now, sent.base) && !sameFences(now, sent.fences);
  return {
    fences: unheard ? sent.fences : now,
    unheard,
    drawn,
    draw,
    add: (at) =>
      draw((before) => (before && before.length < kMostCorners ? [...before, corner(at)] : before)),
    set: (fences) =>
      orders.give(async (lease_id) => {
        await calls.setFences(robot.id, { lease_id, fences: told(fences) });
        setSent({ fences, base: now });
        draw(null);
      }),
    orders,
  };
}

interface Props {
  robot: Robot;
  exploration: Exploration;
  handle: FencesHandle;
  barrier: string | null;
  mayOrder: boolean;
}

/** What it keeps off: the fences that there are, and drawing another one. */
export function FencesCard({ robot, exploration, handle, barrier, mayOrder }: Props) {
  const { fences, unheard, drawn, draw, set, orders } = handle;
  const begin = useRef<HTMLButtonElement>(null);
  const was = useRef(false);
  useEffect(() => {
    if (was.current && drawn === null) begin.current?.focus({ preventScroll: true });
    was.current = drawn !== null;
  }, [drawn]);
  const off = orders.busy || barrier !== null;
  return (
    <section class="card stack" aria-labelledby="explore-fences">
      <h2 id="explore-fences">Fences</h2>
      {drawn === null && (
        <p class="soft">
          {robot.name} chooses no way over a fence: put one around stairs and tables. Going round things may
          lead over it for a moment, so block stairs too.
        </p>
      )}
      {fences.length > 0 && (
        <ol class="list">
          {fences.map((fence, n) => (
            <li key={n}>
              <div>
                <strong>Fence {n + 1}</strong>
                <p class="soft small">{fenceText(fence)}</p>
              </div>
              {mayOrder && (
                <SureButton
                  label="Remove"
                  about={`fence ${n + 1}`}
                  question="Remove this fence?"
                  disabled={off}
                  onSure={() => set(fences.filter((_, at) => at !== n))}
                />
              )}
            </li>
          ))}
        </ol>
      )}
      {unheard && <Notice>Sent. {robot.name} has not said yet that it knows.</Notice>}
      {mayOrder && drawn === null && (
        <div class="row">
          <button type="button" class="button" ref={begin} onClick={() => draw([])}>
            Draw a fence
          </button>
        </div>
      )}
      {mayOrder && drawn !== null && (
        <Drawing drawn={drawn} exploration={exploration} handle={handle} off={off} />
      )}
      {barrier !== null && drawn !== null && (
        <Notice tone="warn" still>
          {barrier}
        </Notice>
      )}
      <OrderNotice robot={robot} orders={orders} />
    </section>
  );
}

interface DrawingProps {
  drawn: readonly Point[];
  exploration: Exploration;
  handle: FencesHandle;
  off: boolean;
}

function Drawing({ drawn, exploration, handle, off }: DrawingProps) {
  const { draw, add, set, fences } = handle;
  const heading = useRef<HTMLHeadingElement>(null);
  useEffect(() => {
    heading.current?.focus({ preventScroll: true });
    document.querySelector('.plan-box')?.scrollIntoView({ block: 'nearest' });
  }, []);
  const left = kLeastCorners - drawn.length;
  return (
    <div class="stack divided" data-testid="drawing">
      <h3 tabIndex={-1} ref={heading}>
        A new fence
      </h3>
      <p>
        Tap its corners on the plan, one after the other. Or drive to each corner with the joystick and add it
        here.
      </p>
      <p role="status">
        <strong>{count(drawn.length, 'corner')}.</strong>{' '}
        {left > 0 ? `${left} more at least.` : 'You can close the fence now.'}
      </p>
      {drawn.length > 0 && (
        <ol class="corners soft small">
          {drawn.map((one, n) => (
            <li key={n}>{cornerText(one)}</li>
          ))}
        </ol>
      )}
      <div class="row">
        <button
          type="button"
          class="button main"
          disabled={off || left > 0}
          onClick={() => set([...fences, drawn])}
        >
          Close the fence
        </button>
        <button
          type="button"
          class="button"
          disabled={drawn.length === 0}
          onClick={() => draw(drawn.slice(0, -1))}
        >
          Take the last corner back
        </button>
        <button type="button" class="button" onClick={() => draw(null)}>
          Cancel
        </button>
      </div>
      <CornerHere exploration={exploration} onAdd={add} />
      <TypedCorner onAdd={add} />
    </div>
  );
}

/** A corner where the robot stands, which somebody has driven there. */
function CornerHere({ exploration, onAdd }: { exploration: Exploration; onAdd: (at: Point) => void }) {
  const { pose } = exploration;
  return (
    <div class="row">
      <button
        type="button"
        class="button"
        disabled={!pose}
        onClick={() => {
          if (pose) onAdd([pose.x_m, pose.y_m]);
        }}
      >
        Corner where the robot stands
      </button>
      {!pose && <span class="soft small">Where it stands is not known.</span>}
    </div>
  );
}

/** A corner by its numbers, for hands that cannot tap, and for those who measured. */
function TypedCorner({ onAdd }: { onAdd: (at: Point) => void }) {
  const [x, setX] = useState('');
  const [y, setY] = useState('');
  const at = typedCorner(x, y);
  const submit = (event: Event) => {
    event.preventDefault();
    if (!at) return;
    onAdd(at);
    setX('');
    setY('');
  };
  return (
    <form class="typed-corner" onSubmit={submit}>
      <TextField label="x in metres" value={x} onInput={setX} required={false} />
      <TextField label="y in metres" value={y} onInput={setY} required={false} />
      <button type="submit" class="button" disabled={!at}>
        Add this corner
      </button>
    </form>
  );
}
