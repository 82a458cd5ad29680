// SPDX-License-Identifier: Apache-2.0
import { useMemo } from 'preact/hooks';
import { connection, now_ms } from '../../api/server';
import type { Graph, MapInfo, Robot } from '../../api/types';
import { exploresNow, isActive, type Journey } from '../go/journey';
import { whereabouts } from '../../lib/whereabouts';
import { planSays } from '../../words/plan_pose';
import { PlanDrawing } from './plan_drawing';
import { PlanLegend } from './plan_legend';
import { PlanOpinion } from './plan_opinion';
import { poseOn } from './plan_pose';
import { chairPlace, chairWords, marksOf, wayOn } from './plan_words';
import { useMapPlan } from './use_map_plan';

interface Props {
  map: MapInfo;
  graph: Graph;
  robot: Robot;
  journey: Journey | null;
}

/** Where the chair is on the building's plan, where the plan itself has it, and where it goes. Nothing while it is
 *  loading, or where it fails: the page says the same in words. */
export function SmallPlan({ map, graph, robot, journey }: Props) {
  const { value } = useMapPlan(map);
  const under_way = journey && isActive(journey.phase) && !journey.explores ? journey : null;
  const goal = under_way?.place ?? null;
  const chair = exploresNow(robot) ? null : chairPlace(robot);
  const marks = useMemo(
    () => (value ? marksOf(value.tie, graph, chair, goal) : []),
    [value, graph, chair, goal],
  );
  if (!value || value.tie.places.length === 0) return null;
  const ahead = under_way ? under_way.path.slice(Math.max(0, under_way.path_index - 1)) : [];
  const words = chairWords(exploresNow(robot) ? null : robot, graph, value.tie, goal);
  const pose = poseOn(map, robot, connection.value.server?.plan_poses ?? {}, now_ms.value);
  const believed = whereabouts(robot.belief, graph)?.where ?? null;
  return (
    <section class="card stack tight" aria-labelledby="small-plan">
      <h2 id="small-plan">Floor plan</h2>
      {pose && <PlanOpinion pose={pose} believed={believed} />}
      <PlanDrawing
        small
        lines={value.lines}
        marks={marks}
        way={wayOn(value.tie, ahead)}
        pose={pose}
        words={`Floor plan. ${words}${pose ? ` ${planSays(pose, believed).words}` : ''}`}
      />
      {pose && <PlanLegend seen brief />}
    </section>
  );
}
