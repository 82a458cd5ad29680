// SPDX-License-Identifier: Apache-2.0
import { signal } from '@preact/signals';
import { connection, graphs, me, wantGraph } from '../../api/server';
import type { Graph, MapInfo, Robot } from '../../api/types';
import { LeasePrompt, WhoDrives } from '../../components/lease_prompt';
import { Notice, Waiting } from '../../components/notice';
import { RobotPicker } from '../../components/robot_picker';
import { chosen, chosenGraph, chosenMap, connected } from '../../lib/chosen';
import { atLeast } from '../../lib/roles';
import { destinationLabel, placeTitle } from '../../lib/whereabouts';
import { titled } from '../../lib/words';
import { SmallPlan } from '../plan/small_plan';
import { DestinationCard } from './destination_card';
import { DiversionPrompt } from './diversion_prompt';
import { commands, forgetCommand, send, type Sure } from './driving';
import { goalsOf, leadsTo, targetOf } from './goals';
import { FirstSteps } from './first_steps';
import { exploresNow, hindrance, journeyOf, type Journey, type Target } from './journey';
import { JourneyCard } from './journey_card';
import { announcement } from './journey_words';
import { QuestionCard } from './question_card';
import { mayBeSaid } from './said_place';
import { SaidPlaceCard } from './said_place_card';
import { WhereaboutsCard } from './whereabouts_card';

const kHereProbability = 0.5;

/** Missions whose end the reader has put away. */
const hidden = signal<ReadonlySet<string>>(new Set());

function hide(robot: string, journey: Journey): void {
  forgetCommand(robot);
  if (journey.id !== null) hidden.value = new Set([...hidden.peek(), journey.id]);
}

export function GoPage() {
  const robot = chosen.value;
  if (connection.value.server === null) return <Waiting what="Asking the server …" />;
  if (!robot)
    return (
      <>
        <h1>Where to?</h1>
        <FirstSteps />
      </>
    );
  return <Going robot={robot} graph={chosenGraph.value} />;
}

function Going({ robot, graph }: { robot: Robot; graph: Graph | null }) {
  const command = commands.value[robot.id];
  const newest = journeyOf(robot, command);
  const journey = newest && newest.id !== null && hidden.value.has(newest.id) ? null : newest;
  const held = command?.kind === 'held' ? command : null;
  const diversion = command?.kind === 'diversion' ? command : null;
  const mayDrive = atLeast(me.value?.role, 'rider');
  const barrier = hindrance(robot, connected.value, mayDrive);
  const go = (target: Target, sure: Sure = {}) => {
    void send(robot.id, target, sure);
    // What becomes of it, or what is asked first, is told at the top; on a phone that may be out of sight.
    requestAnimationFrame(() => document.getElementById('go-top')?.scrollIntoView({ block: 'nearest' }));
  };
  const again = journey && !journey.explores && againTarget(journey.destination, journey.place, graph);
  return (
    <>
      <div class="row apart">
        <h1>Where to?</h1>
        <RobotPicker />
      </div>
      {robot.map === null && !exploresNow(robot) && <FirstSteps />}
      {barrier !== null && (robot.map !== null || exploresNow(robot)) && (
        <Notice tone="warn" still>
          {barrier}
        </Notice>
      )}
      <div id="go-top" />
      {held && (
        <LeasePrompt
          holder={held.holder}
          chair="the chair"
          question={`Take over and go to ${held.target.label}?`}
          onTakeOver={() => go(held.target, { take_over: true })}
          onLeave={() => forgetCommand(robot.id)}
        />
      )}
      {diversion && (
        <DiversionPrompt
          name={robot.name}
          journey={newest}
          graph={graph}
          target={diversion.target}
          disabled={barrier !== null}
          onGo={() => go(diversion.target, { divert: true })}
          onLeave={() => forgetCommand(robot.id)}
        />
      )}
      {/* There from the start, so that screen readers announce each change of it. */}
      <p class="hidden-text" role="status">
        {journey && announcement(journey, graph)}
      </p>
      <QuestionCard robot={robot} mayAnswer={mayDrive} />
      <div class={journey ? 'go-top two' : 'go-top'}>
        <WhereaboutsCard robot={robot} graph={graph} />
        {journey && (
          <JourneyCard
            robot={robot}
            journey={journey}
            graph={graph}
            onAgain={again && barrier === null && journey.phase !== 'arrived' ? () => go(again) : null}
            onDismiss={() => hide(robot.id, journey)}
          />
        )}
      </div>
      {graph && mayBeSaid(robot, connected.value, mayDrive) && (
        <SaidPlaceCard key={robot.id} robot={robot} graph={graph} />
      )}
      <WhoDrives robot={robot} />
      <section class="stack" aria-label="Places to go to">
        {graph ? (
          <Destinations
            robot={robot}
            graph={graph}
            disabled={barrier !== null || command?.kind === 'asking'}
            journey={journey}
            onGo={go}
          />
        ) : (
          <NoGraph map={chosenMap.value} />
        )}
      </section>
      {graph && chosenMap.value?.plan && (
        <SmallPlan map={chosenMap.value} graph={graph} robot={robot} journey={journey} />
      )}
    </>
  );
}

function againTarget(destination: string | null, place: string | null, graph: Graph | null): Target | null {
  const found = graph?.destinations.find((one) => one.id === destination);
  if (graph && found) return { destination: found.id, label: titled(destinationLabel(graph, found)) };
  return place === null ? null : { place, label: graph ? placeTitle(graph, place) : 'the place you chose' };
}

interface DestinationsProps {
  robot: Robot;
  graph: Graph;
  disabled: boolean;
  journey: Journey | null;
  onGo: (target: Target) => void;
}

function Destinations({ robot, graph, disabled, journey, onGo }: DestinationsProps) {
  const goals = goalsOf(graph);
  if (goals.length === 0)
    return <Notice still>This map has no named places yet. Give some a name under Map.</Notice>;
  const { belief } = robot;
  // Of the place alone: next to it is not there.
  const share = belief?.top.find((one) => one.place === belief.place)?.probability ?? 0;
  const sure = belief && !exploresNow(robot) && !belief.lost && share > kHereProbability;
  return (
    <ul class="destinations">
      {goals.map((goal) => (
        <DestinationCard
          key={goal.key}
          goal={goal}
          graph={graph}
          phase={journey && leadsTo(journey, goal) ? journey.phase : null}
          here={sure === true && robot.belief?.place === goal.place}
          disabled={disabled}
          onGo={() => onGo(targetOf(goal))}
        />
      ))}
    </ul>
  );
}

function NoGraph({ map }: { map: MapInfo | null }) {
  if (!map) return null;
  const error = graphs.value[map.id]?.error;
  if (error)
    return (
      <Notice tone="bad">
        <div class="row apart">
          <span>The map could not be loaded. {error.message}</span>
          <button type="button" class="button" onClick={() => wantGraph(map, true)}>
            Try again
          </button>
        </div>
      </Notice>
    );
  if (map.state === 'building') return <Waiting what="The map is being built …" />;
  if (map.state === 'failed') return <Notice tone="warn">The map could not be built. See Tours.</Notice>;
  return <Waiting what="Loading the map …" />;
}
