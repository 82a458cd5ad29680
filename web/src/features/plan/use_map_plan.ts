// SPDX-License-Identifier: Apache-2.0
import * as calls from '../../api/calls';
import type { MapInfo, MapPlan, PlanLines } from '../../api/types';
import { useLoaded, type Loaded } from '../../lib/loaded';

export interface MapOnPlan {
  tie: MapPlan;
  lines: PlanLines;
}

const kRevisions = 1000; // two ties are never less than a millisecond apart

/** The lines of a version of a plan stay as they are, so each is asked for once. */
const known = new Map<string, Promise<PlanLines>>();

export function linesOf(plan: string, version: number): Promise<PlanLines> {
  const key = `${plan} ${version}`;
  let lines = known.get(key);
  if (!lines) {
    lines = calls.planLines(plan, version);
    known.set(key, lines);
    lines.catch(() => known.delete(key)); // whoever asks again may have more luck
  }
  return lines;
}

/** Where a map lies on its plan, asked for anew when it is tied anew or has another revision. */
export function useMapPlan(map: MapInfo): Loaded<MapOnPlan | null> {
  const version = map.plan ? map.plan.tied_us + (map.revision % kRevisions) : 0;
  return useLoaded(async () => {
    if (!map.plan) return null;
    const tie = await calls.mapPlan(map.id);
    return { tie, lines: await linesOf(tie.plan, tie.version) };
  }, version);
}
