// SPDX-License-Identifier: Apache-2.0
import * as calls from '../../api/calls';
import type { Exploration, Robot } from '../../api/types';
import { Bar, Notice } from '../../components/notice';
import { Section } from '../../components/section';
import { SureButton } from '../../components/sure_button';
import { connected } from '../../lib/chosen';
import { follow } from '../../lib/router';
import { count, percent } from '../../lib/words';
import { forgetCommand } from '../go/driving';
import { exploresNow } from '../go/journey';
import { stop } from '../go/stop';
import { LimitFields, useLimits } from './limits';
import { OrderNotice, useOrders } from './ordering';
import { figures, stageWords, whyWords, type Stage } from './phase_words';

interface Props {
  robot: Robot;
  exploration: Exploration | null;
  stage: Exclude<Stage, 'none'>;
  barrier: string | null;
  mayOrder: boolean;
}

/** How far it is and why, in words and numbers, with what can be done about it. */
export function StatusCard({ robot, exploration, stage, barrier, mayOrder }: Props) {
  const { title, pill, tone } = stageWords(stage, robot.name, exploration);
  const current = connected.value && robot.online;
  const moves = stage === 'starting' || stage === 'exploring' || (stage === 'waiting' && exploresNow(robot));
  return (
    <section
      class="card stack explore-status"
      aria-label="How far it is"
      data-phase={stage}
      data-testid="status"
    >
      <div class="row apart">
        <h2>{title}</h2>
        <span class={`pill ${current ? tone : 'warn'}`}>{current ? pill : 'As last heard'}</span>
      </div>
      {whyWords(robot, exploration).map((why) => (
        <p key={why}>{why}</p>
      ))}
      {exploration && <Figures exploration={exploration} />}
      {(stage === 'ended' || stage === 'uploaded') && exploration && <Upload exploration={exploration} />}
      {barrier !== null && stage !== 'uploaded' && (
        <Notice tone="warn" still>
          {barrier}
        </Notice>
      )}
      {mayOrder && moves && (
        <div class="row">
          <button type="button" class="button" onClick={() => void stop(robot.id)}>
            Pause
          </button>
          <span class="soft small">It stands then, and can go on later.</span>
        </div>
      )}
      {mayOrder && stage === 'paused' && exploration && (
        <Paused robot={robot} exploration={exploration} barrier={barrier} />
      )}
    </section>
  );
}

function Figures({ exploration }: { exploration: Exploration }) {
  return (
    <dl class="facts explore-figures">
      {figures(exploration).map(([name, value]) => (
        <div key={name}>
          <dt>{name}</dt>
          <dd>{value}</dd>
        </div>
      ))}
    </dl>
  );
}

/** Its pictures on their way, and what can be made of them. */
function Upload({ exploration }: { exploration: Exploration }) {
  const { uploaded, tour, phase, pictures } = exploration;
  if (phase === 'uploaded')
    return tour === null ? null : (
      <p>
        <a class="button main" href={`/tours/${encodeURIComponent(tour)}`} onClick={follow}>
          Build a map of it
        </a>
      </p>
    );
  return (
    <div class="stack tight">
      <Bar share={uploaded} label="Pictures on the server" />
      <p class="soft small">
        {percent(uploaded)} of {count(pictures, 'picture')} on the server. The robot needs nobody for this.
      </p>
    </div>
  );
}

interface PausedProps {
  robot: Robot;
  exploration: Exploration;
  barrier: string | null;
}

function Paused({ robot, exploration, barrier }: PausedProps) {
  const limits = useLimits();
  const orders = useOrders(robot.id);
  const off = orders.busy || barrier !== null;
  const goOn = () => {
    const { limits: wanted } = limits;
    if (!wanted) return;
    forgetCommand(robot.id);
    const more = { ...wanted, exploration: exploration.id };
    orders.give((lease_id) => calls.explore(robot.id, { ...more, lease_id }));
  };
  return (
    <div class="stack">
      <p class="soft">It goes on from where it stands now. Please do not move it meanwhile.</p>
      <div class="row">
        <button type="button" class="button main" disabled={off || limits.limits === null} onClick={goOn}>
          {orders.busy ? 'One moment …' : 'Go on'}
        </button>
        <SureButton
          label="Finish with what there is"
          about="now"
          question={`Make a tour of ${count(exploration.pictures, 'picture')}? It cannot go on after that.`}
          disabled={off}
          leave="Not yet"
          onSure={() => orders.give((lease_id) => calls.finishExploration(robot.id, lease_id))}
        />
      </div>
      <Section title="Limits for going on" heading={false}>
        <LimitFields {...limits} />
      </Section>
      <OrderNotice robot={robot} orders={orders} />
    </div>
  );
}
