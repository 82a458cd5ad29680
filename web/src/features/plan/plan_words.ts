// SPDX-License-Identifier: Apache-2.0
import type { Graph, MapPlan, PlanVersion, Robot } from '../../api/types';
import { nameOf, placeTitle, whereabouts } from '../../lib/whereabouts';
import { count, titled } from '../../lib/words';
import type { Mark } from './plan_drawing';
import type { Spot } from './plan_geometry';

/** The place where a robot believes to be; null where nobody knows, or it is on no map now. */
export function chairPlace(robot: Robot | null): string | null {
  return robot?.online && robot.belief && !robot.belief.lost ? robot.belief.place : null;
}

/** Signs of all places, of the chair and of where it goes. */
export function marksOf(tie: MapPlan, graph: Graph, chair: string | null, goal: string | null): Mark[] {
  const titleOf = (place: string) => titled(nameOf(graph, place) ?? '');
  // A larger sign at a place carries its name, so that none lies over the other.
  const covered = new Set([goal, chair]);
  const marks: Mark[] = tie.places.map(({ place, x_m, y_m, pinned }) => ({
    key: place,
    kind: pinned ? 'pinned' : 'place',
    x_m,
    y_m,
    label: covered.has(place) ? '' : titleOf(place),
  }));
  const sign = (place: string | null, kind: 'goal' | 'chair', label: string) => {
    const at = tie.places.find((one) => one.place === place);
    if (at) marks.push({ key: kind, kind, x_m: at.x_m, y_m: at.y_m, label });
  };
  if (goal !== null) sign(goal, 'goal', goal === chair ? '' : titleOf(goal));
  if (chair !== null) sign(chair, 'chair', titleOf(chair));
  return marks;
}

/** The way over the plan, as far as its places are on it. */
export function wayOn(tie: MapPlan, places: readonly string[]): Spot[] {
  const spots = new Map(tie.places.map((one) => [one.place, one]));
  return places.flatMap((place) => spots.get(place) ?? []);
}

/** What the plan shows of a robot, for those who do not see it. */
export function chairWords(robot: Robot | null, graph: Graph, tie: MapPlan, goal: string | null): string {
  const place = chairPlace(robot);
  const where = robot && place !== null ? whereabouts(robot.belief, graph)?.where : null;
  const here =
    place === null
      ? 'Where the chair is, is not known.'
      : !tie.places.some((one) => one.place === place)
        ? 'The chair is at a place that is not on the plan.'
        : `The chair is ${where ?? 'on the plan'}.`;
  return goal === null ? here : `${here} It goes to ${placeTitle(graph, goal)}.`;
}

/** How well the map lies on the plan. */
export function fitWords(tie: MapPlan): string {
  if (tie.rms_m === null)
    return 'No place is on the plan: of the pinned pictures too few are in the map. Pin two places again.';
  const off = `Pinned places are ${metres(tie.rms_m)} off what the map says, on average.`;
  const left = tie.unplaced.length;
  return left === 0
    ? off
    : `${off} ${count(left, 'place')} of parts without two pins ${left === 1 ? 'is' : 'are'} not on the plan.`;
}

export function metres(value_m: number): string {
  return `${value_m.toFixed(value_m < 10 ? 2 : 0)} m`;
}

/** "14.2 m by 10.7 m, 812 lines" */
export function sizeWords({ extent, lines }: PlanVersion): string {
  const [across, along] = [extent.max_x_m - extent.min_x_m, extent.max_y_m - extent.min_y_m];
  return `${metres(across)} by ${metres(along)}, ${count(lines, 'line')}`;
}
