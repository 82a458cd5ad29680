// SPDX-License-Identifier: Apache-2.0
import { sentence } from '../../api/problem';
import type { Graph } from '../../api/types';
import { placeTitle } from '../../lib/whereabouts';
import { titled } from '../../lib/words';
import type { Journey, Phase } from './journey';

/** The name of where a journey goes, for people. */
export function goalName(journey: Journey, graph: Graph | null): string {
  const destination = graph?.destinations.find(
    (one) => one.id === journey.destination || (journey.destination === null && one.place === journey.place),
  );
  if (destination?.label) return titled(destination.label);
  if (graph && journey.place !== null) return placeTitle(graph, journey.place);
  return 'the place you chose';
}

const kHeadings: Readonly<Record<Phase, (goal: string) => string>> = {
  asking: (goal) => `Asking to go to ${goal} …`,
  accepted: (goal) => `About to start: ${goal}`,
  driving: (goal) => `On the way to ${goal}`,
  arrived: (goal) => `Arrived: ${goal}`,
  refused: (goal) => `Cannot go to ${goal}`,
  stopped: (goal) => `Stopped on the way to ${goal}`,
  failed: (goal) => `Did not reach ${goal}`,
};

export function heading(journey: Journey, graph: Graph | null): string {
  return kHeadings[journey.phase](goalName(journey, graph));
}

/** Why it ended without arriving, why it goes another way, or what was not right when it arrived; null: nothing. */
export function reasonOf(journey: Journey): string | null {
  if (journey.phase === 'asking') return null;
  return journey.reason ? sentence(journey.reason) : null;
}

export function toneOf(phase: Phase): 'good' | 'warn' | 'bad' {
  if (phase === 'refused' || phase === 'failed') return 'bad';
  return phase === 'stopped' ? 'warn' : 'good';
}
