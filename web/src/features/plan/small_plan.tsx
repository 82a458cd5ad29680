// SPDX-License-Identifier: Apache-2.0
import { useMemo } from 'preact/hooks';
import type { Graph, MapInfo, Robot } from '../../api/types';
import { exploresNow, isActive, type Journey } from '../go/journey';
import { PlanDrawing } from './plan_drawing';
import { chairPlace, chairWords, marksOf, wayOn } from './plan_words';
import { useMapPlan } from './use_map_plan';

interface Props {
  map: MapInfo;
  graph: Graph;
  robot: Robot;
  journey: Journey | null;
}

/** Where the chair is on the building's plan, and where it goes. Nothing while it is loading, or where it fails: the page
 *  says the same in words. */
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
  return (
    <section class="card stack tight" aria-labelledby="small-plan">
      <h2 id="small-plan">Floor plan</h2>
      <PlanDrawing
        small
        lines={value.lines}
        marks={marks}
        way={wayOn(value.tie, ahead)}
        words={`Floor plan. ${words}`}
      />
    </section>
  );
}
