// SPDX-License-Identifier: Apache-2.0
import { useEffect, useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import { me } from '../../api/server';
import type { Exploration, Robot } from '../../api/types';
import { Notice } from '../../components/notice';
import { useCommand } from '../../lib/command';
import { explorePath } from '../../lib/explore_address';
import { follow } from '../../lib/router';
import { withLeaseOnce } from '../go/driving';
import { OrderNotice, useOrders } from './ordering';
import {
  bondOf,
  bondWords,
  goesOn,
  isFree,
  offerWords,
  told,
  unheard,
  type Party,
  type Told,
} from './together_words';

interface Props {
  robot: Robot;
  exploration: Exploration;
  others: readonly Party[];
  barrier: string | null;
  mayOrder: boolean;
}

/** So long it is waited for what a robot makes of what it was told: that may have got lost on the way. */
const WAITS_MS = 10_000;

/** With which other robot it maps the building: choosing one, how far the two are, and parting again. */
export function TogetherCard({ robot, exploration, others, barrier, mayOrder }: Props) {
  const orders = useOrders(robot.id);
  const [sent, setSent] = useState<readonly Told[]>([]);
  useEffect(() => {
    if (sent.length === 0) return;
    const over = setTimeout(() => setSent([]), WAITS_MS);
    return () => clearTimeout(over);
  }, [sent]);
  const own = { robot, exploration };
  const bond = bondOf(exploration, others);
  const waited = unheard(sent, [own, ...others]);
  const words = waited === null ? bondWords(bond, robot.name, exploration) : null;
  const partner = bond.kind === 'none' ? null : bond.other?.robot.name;
  const off = orders.busy || barrier !== null;
  const offers = others.filter(goesOn);
  const alone = bond.kind === 'none' || (bond.kind === 'silent' && offers.length > 0);
  // Tells this robot, and the other one as well where nobody else drives that.
  const choose = (other: Party | null, also: Party | null) =>
    orders.give(async (lease_id) => {
      await calls.setCompanion(robot.id, { lease_id, robot: other?.robot.id ?? null });
      const news = [told(own, other?.exploration?.id ?? null)];
      if (also && (await tell(also.robot, other && robot.id).catch(() => false)))
        news.push(told(also, other && exploration.id));
      setSent(news);
    });
  return (
    <section
      class="card stack"
      aria-labelledby="explore-together"
      data-bond={bond.kind}
      data-testid="together"
    >
      <div class="row apart">
        <h2 id="explore-together">Together with {partner ?? 'another robot'}</h2>
        {words && <span class={`pill ${words.tone}`}>{words.pill}</span>}
      </div>
      {words && <p role="status">{words.says}</p>}
      {(bond.kind === 'looking' || bond.kind === 'joined') && (
        <p class="soft small">A fence of one does not hold the other: draw it for both.</p>
      )}
      {waited !== null && <Notice>Sent. {waited} has not said yet that it knows.</Notice>}
      {waited === null && alone && mayOrder && (
        <Offers
          own={own}
          offers={offers}
          off={off}
          onChoose={(other) => choose(other, isFree(other) ? other : null)}
        />
      )}
      {waited === null && bond.kind === 'one_sided' && mayOrder && (
        <OtherHalf robot={robot} other={bond.other} />
      )}
      {waited === null && bond.kind !== 'none' && mayOrder && (
        <div class="row">
          <button
            type="button"
            class="button"
            disabled={off}
            onClick={() =>
              choose(null, bond.kind === 'looking' || bond.kind === 'joined' ? bond.other : null)
            }
          >
            Each by itself again
          </button>
        </div>
      )}
      <OrderNotice robot={robot} orders={orders} />
    </section>
  );
}

/** Tells another robot with whom it shares; with its lease, which is not taken from somebody else. */
async function tell(other: Robot, companion: string | null): Promise<true> {
  await withLeaseOnce(other.id, (lease_id) => calls.setCompanion(other.id, { lease_id, robot: companion }));
  return true;
}

interface OffersProps {
  own: { robot: Robot; exploration: Exploration };
  offers: readonly Party[];
  off: boolean;
  onChoose: (other: Party) => void;
}

/** The robots with which it could map the building. */
function Offers({ own, offers, off, onChoose }: OffersProps) {
  if (offers.length === 0)
    return (
      <p class="soft">
        No other robot maps the building now. Let another one start, and choose it here: then each leaves to
        the other what that one sees to.
      </p>
    );
  return (
    <>
      <p class="soft">Two robots at once: each leaves to the other what that one sees to.</p>
      <ul class="list">
        {offers.map((offer) => (
          <li key={offer.robot.id}>
            <div>
              <strong>{offer.robot.name}</strong>
              <p class="soft small">{offerWords(offer, own.exploration)}</p>
            </div>
            <button
              type="button"
              class="button"
              disabled={off}
              aria-label={`Map together with ${offer.robot.name}`}
              onClick={() => onChoose(offer)}
            >
              Map together
            </button>
          </li>
        ))}
      </ul>
    </>
  );
}

/** What is left to do: the other robot has to share with this one too. */
function OtherHalf({ robot, other }: { robot: Robot; other: Party }) {
  const { busy, problem, run } = useCommand();
  const { name, lease, id } = other.robot;
  const holder = lease && lease.holder !== me.value?.name ? lease.holder : null;
  return (
    <>
      {holder !== null && (
        <Notice tone="warn" still>
          {holder} is driving {name}: ask {holder} to choose {robot.name} on the page of {name}, or take over
          there, which stops it.
        </Notice>
      )}
      {holder === null && !isFree(other) && (
        <Notice tone="warn" still>
          {name} shares with another robot, and parts from that when it is told.
        </Notice>
      )}
      <div class="row">
        {holder === null && (
          <button
            type="button"
            class="button main"
            disabled={busy}
            onClick={() => run(() => tell(other.robot, robot.id))}
          >
            {busy ? 'One moment …' : `Tell ${name} too`}
          </button>
        )}
        <a class="button" href={explorePath(id)} onClick={follow}>
          To the page of {name}
        </a>
      </div>
      {problem && <Notice tone="bad">{problem.message}</Notice>}
    </>
  );
}
