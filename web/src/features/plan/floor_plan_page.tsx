// SPDX-License-Identifier: Apache-2.0
import { useMemo, useState } from 'preact/hooks';
import * as calls from '../../api/calls';
import { connection, now_ms } from '../../api/server';
import type { Graph, MapInfo, PlanInfo } from '../../api/types';
import { Choice } from '../../components/field';
import { Loading } from '../../components/loading';
import { Notice } from '../../components/notice';
import { SureButton } from '../../components/sure_button';
import { chosen } from '../../lib/chosen';
import { useCommand } from '../../lib/command';
import { useLoaded } from '../../lib/loaded';
import { follow } from '../../lib/router';
import { whereabouts } from '../../lib/whereabouts';
import { planSays } from '../../words/plan_pose';
import { isActive } from '../go/journey';
import { PinEditor } from './pin_editor';
import { PinnedPlaces } from './pinned_places';
import { PlanDrawing } from './plan_drawing';
import { PlanLegend } from './plan_legend';
import { PlanOpinion } from './plan_opinion';
import { poseOn } from './plan_pose';
import { chairPlace, chairWords, fitWords, marksOf, wayOn } from './plan_words';
import { linesOf, useMapPlan, type MapOnPlan } from './use_map_plan';

interface Props {
  map: MapInfo;
  graph: Graph;
  mayEdit: boolean;
}

/** A version of a plan onto which somebody lays the map. */
interface Begun {
  plan: string;
  version: number;
  keeps: boolean; // the pins that the map has
}

/** The map on the building's plan, with the chair; installers say where places lie on it. */
export function FloorPlanPage({ map, graph, mayEdit }: Props) {
  const [begun, setBegun] = useState<Begun | null>(null);
  const placed = useMapPlan(map);
  return (
    <section class="stack" aria-labelledby="floor-plan">
      <h2 id="floor-plan">Floor plan</h2>
      {begun ? (
        <Pinning
          key={`${begun.plan} ${begun.version}`}
          map={map}
          graph={graph}
          begun={begun}
          placed={placed.value}
          onDone={() => setBegun(null)}
        />
      ) : map.plan ? (
        <Loading of={placed} what="The floor plan">
          {(on_plan) =>
            on_plan && (
              <Placed map={map} graph={graph} on_plan={on_plan} mayEdit={mayEdit} onBegin={setBegun} />
            )
          }
        </Loading>
      ) : (
        <Untied mayEdit={mayEdit} onBegin={setBegun} />
      )}
    </section>
  );
}

function Placed({
  map,
  graph,
  on_plan: { tie, lines },
  mayEdit,
  onBegin,
}: Props & { on_plan: MapOnPlan; onBegin: (begun: Begun) => void }) {
  const { busy, problem, run } = useCommand();
  const robot = chosen.value?.map === map.id ? chosen.value : null;
  const mission = robot?.mission && isActive(robot.mission.state) ? robot.mission : null;
  const goal = mission && mission.kind === 'drive' ? mission.place : null;
  const chair = chairPlace(robot);
  const marks = useMemo(() => marksOf(tie, graph, chair, goal), [tie, graph, chair, goal]);
  const ahead = mission ? mission.path.slice(Math.max(0, mission.path_index - 1)) : [];
  const words = robot ? chairWords(robot, graph, tie, goal) : 'No robot is on this map.';
  const pose = poseOn(map, robot, connection.value.server?.plan_poses ?? {}, now_ms.value);
  const believed = whereabouts(robot?.belief ?? null, graph)?.where ?? null;
  return (
    <>
      <p role="status">{words}</p>
      {pose && <PlanOpinion pose={pose} believed={believed} />}
      <PlanDrawing
        lines={lines}
        marks={marks}
        way={wayOn(tie, ahead)}
        pose={pose}
        words={`Floor plan with ${tie.places.length} places. ${words}${pose ? ` ${planSays(pose, believed).words}` : ''}`}
      />
      <PlanLegend seen={pose !== null} />
      <p class="soft">{fitWords(tie)}</p>
      <PinnedPlaces tie={tie} graph={graph} />
      {mayEdit && (
        <div class="row">
          <button
            type="button"
            class="button main"
            onClick={() => onBegin({ plan: tie.plan, version: tie.version, keeps: true })}
          >
            Change where places lie
          </button>
          {tie.newest_version > tie.version && (
            <button
              type="button"
              class="button"
              onClick={() => onBegin({ plan: tie.plan, version: tie.newest_version, keeps: true })}
            >
              Go on to version {tie.newest_version} of the plan
            </button>
          )}
          <SureButton
            label="Take the map off this plan"
            about={map.name}
            question="Take the map off the plan? Where its places lie is forgotten."
            disabled={busy}
            onSure={() => run(() => calls.untieMap(map.id))}
          />
        </div>
      )}
      {problem && <Notice tone="bad">{problem.message}</Notice>}
    </>
  );
}

/** Nothing to show yet: who may install things chooses a plan. */
function Untied({ mayEdit, onBegin }: { mayEdit: boolean; onBegin: (begun: Begun) => void }) {
  const plans = useLoaded(calls.plans);
  if (!mayEdit)
    return (
      <Notice still>This map lies on no floor plan. Somebody who may install things can do that.</Notice>
    );
  return (
    <Loading of={plans} what="The plans">
      {(answer) =>
        answer.plans.length === 0 ? (
          <Notice still>
            There is no plan of the building yet. Upload one under{' '}
            <a href="/tours" onClick={follow}>
              Tours
            </a>
            .
          </Notice>
        ) : (
          <ChoosePlan plans={answer.plans} onBegin={onBegin} />
        )
      }
    </Loading>
  );
}

function ChoosePlan({ plans, onBegin }: { plans: readonly PlanInfo[]; onBegin: (begun: Begun) => void }) {
  const [id, setId] = useState(plans[0]?.id ?? '');
  const plan = plans.find((one) => one.id === id);
  const newest = plan?.versions.at(-1);
  return (
    <div class="card stack">
      <p>
        This map lies on no floor plan yet. Choose one, and say of two places or more where they are on it.
      </p>
      <Choice
        label="Plan"
        value={id}
        onChange={setId}
        options={plans.map((one) => ({ value: one.id, label: one.name }))}
      />
      <p>
        <button
          type="button"
          class="button main"
          disabled={!plan || !newest}
          onClick={() => plan && newest && onBegin({ plan: plan.id, version: newest.version, keeps: false })}
        >
          Lay the map onto this plan
        </button>
      </p>
    </div>
  );
}

interface PinningProps {
  map: MapInfo;
  graph: Graph;
  begun: Begun;
  placed: MapOnPlan | null;
  onDone: () => void;
}

function Pinning({ map, graph, begun, placed, onDone }: PinningProps) {
  const lines = useLoaded(() => linesOf(begun.plan, begun.version));
  return (
    <Loading of={lines} what="The plan">
      {(drawn) => (
        <PinEditor
          map={map}
          graph={graph}
          lines={drawn}
          tie={begun.keeps ? (placed?.tie ?? null) : null}
          onDone={onDone}
        />
      )}
    </Loading>
  );
}
