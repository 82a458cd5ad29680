// SPDX-License-Identifier: Apache-2.0
import { useEffect } from 'preact/hooks';
import { connection, me } from '../../api/server';
import type { Exploration, Robot } from '../../api/types';
import { WhoDrives } from '../../components/lease_prompt';
import { Notice, Waiting } from '../../components/notice';
import { Section } from '../../components/section';
import { choose, connected, robots } from '../../lib/chosen';
import { atLeast } from '../../lib/roles';
import { follow } from '../../lib/router';
import { LivePicture } from '../robots/live_picture';
import { StatusCard } from './controls';
import { FencesCard, useFences } from './fences';
import { Intro } from './intro';
import { barrierOf, planWords, stageOf, stageWords, type Stage } from './phase_words';
import { Plan, PlanLegend } from './plan';
import { TogetherCard } from './together';
import { useExploration } from './use_exploration';
import { useOthers } from './use_others';

/** A robot maps a building by itself while a person watches. */
export function ExplorePage({ id }: { id: string }) {
  const robot = robots.value.find((one) => one.id === id);
  if (connection.value.server === null) return <Waiting what="Asking the server …" />;
  return (
    <>
      <p>
        <a href="/robots" onClick={follow}>
          ← All robots
        </a>
      </p>
      {robot ? (
        <OfRobot key={robot.id} robot={robot} />
      ) : (
        <Notice tone="warn">There is no such robot.</Notice>
      )}
    </>
  );
}

function OfRobot({ robot }: { robot: Robot }) {
  // STOP is about the robot of this page.
  useEffect(() => choose(robot.id), [robot.id]);
  const { exploration, known, problem } = useExploration(robot.id);
  const mayOrder = atLeast(me.value?.role, 'installer');
  const barrier = barrierOf(robot, connected.value);
  const stage = stageOf(robot, exploration);
  return (
    <>
      <h1>{stage === 'none' ? `Let ${robot.name} map a building` : `${robot.name} maps a building`}</h1>
      <p class="hidden-text" role="status">
        {stage !== 'none' && stageWords(stage, robot.name, exploration).title}
      </p>
      {problem && <Notice tone="bad">How far it is could not be asked. {problem.message}</Notice>}
      <WhoDrives robot={robot} />
      {!known && stage === 'none' && <Waiting what="Asking how far it is …" />}
      {known && stage === 'none' && <Intro robot={robot} barrier={barrier} mayOrder={mayOrder} />}
      {stage !== 'none' && (
        <Watching
          robot={robot}
          exploration={stage === 'starting' && !isPresent(robot, exploration) ? null : exploration}
          stage={stage}
          barrier={barrier}
          mayOrder={mayOrder}
        />
      )}
      {stage === 'uploaded' && mayOrder && (
        <Section title="Let it map a building once more" heading={false}>
          <Intro robot={robot} barrier={barrier} mayOrder />
        </Section>
      )}
    </>
  );
}

/** Whether it is what the robot was sent to, not one of before. */
function isPresent(robot: Robot, exploration: Exploration | null): boolean {
  return exploration !== null && robot.mission?.exploration === exploration.id;
}

interface WatchingProps {
  robot: Robot;
  exploration: Exploration | null;
  stage: Exclude<Stage, 'none'>;
  barrier: string | null;
  mayOrder: boolean;
}

function Watching({ robot, exploration, stage, barrier, mayOrder }: WatchingProps) {
  const handle = useFences(robot, exploration);
  const fenced = exploration !== null && stage !== 'ended' && stage !== 'uploaded';
  const drawing = fenced && handle.drawn !== null;
  const others = useOthers(robot.id);
  const withFences = fenced && (mayOrder || handle.fences.length > 0);
  const shared = (exploration?.companion ?? null) !== null;
  const together = fenced && (shared || (mayOrder && others.length > 0));
  return (
    <div class="explore">
      <StatusCard
        robot={robot}
        exploration={exploration}
        stage={stage}
        barrier={barrier}
        mayOrder={mayOrder}
      />
      <section class="card stack explore-plan" aria-labelledby="explore-plan">
        <h2 id="explore-plan">Plan</h2>
        <Plan
          exploration={exploration}
          fences={handle.fences}
          drawn={drawing ? handle.drawn : null}
          words={planWords(exploration, stage, robot.name)}
          onTap={drawing ? handle.add : null}
        />
        {!drawing && <PlanLegend />}
      </section>
      {(withFences || together) && (
        <div class="explore-orders">
          {withFences && (
            <FencesCard
              robot={robot}
              exploration={exploration}
              handle={handle}
              barrier={barrier}
              mayOrder={mayOrder}
            />
          )}
          {together && (
            <TogetherCard
              robot={robot}
              exploration={exploration}
              others={others}
              barrier={barrier}
              mayOrder={mayOrder}
            />
          )}
        </div>
      )}
      <section class="card explore-picture" aria-label={`Camera of ${robot.name}`}>
        <LivePicture robot={robot} />
      </section>
      {!mayOrder && stage !== 'uploaded' && (
        <Notice still>Somebody who may install things guides it. You may watch, and you may stop it.</Notice>
      )}
    </div>
  );
}
