// SPDX-License-Identifier: Apache-2.0
import type { Graph } from '../../api/types';
import { pictogramOf, suggestedBy, type PictogramName } from '../../lib/pictograms';
import { destinationLabel } from '../../lib/whereabouts';
import { titled } from '../../lib/words';
import { leadsThere, type Journey, type Target } from './journey';

/** Something that a rider can choose: a destination of the tour, or another place that a person has named. */
export interface Goal {
  key: string;
  destination: string | null;
  place: string;
  image: string;
  name: string;
  pictogram: PictogramName | null; // by which its card is known without reading
}

export function goalsOf(graph: Graph): Goal[] {
  const destinations = graph.destinations.map((one) => {
    const name = titled(destinationLabel(graph, one)) || one.place;
    return {
      key: `d ${one.id} ${one.image}`,
      destination: one.id,
      place: one.place,
      image: one.image,
      name,
      pictogram: pictogramOf(one.pictogram, name),
    };
  });
  const covered = new Set(destinations.map((one) => one.place));
  const named = graph.places
    .filter((one) => one.label.trim() !== '' && !covered.has(one.id))
    .map((one) => ({
      key: `p ${one.id}`,
      destination: null,
      place: one.id,
      image: one.prototype,
      name: titled(one.label),
      pictogram: suggestedBy(one.label),
    }));
  return [...destinations, ...named];
}

export function targetOf(goal: Goal): Target {
  return goal.destination === null
    ? { place: goal.place, label: goal.name }
    : { destination: goal.destination, label: goal.name };
}

/** Whether a journey leads to this goal. */
export function leadsTo(journey: Journey, goal: Goal): boolean {
  return leadsThere(journey, targetOf(goal));
}
