// SPDX-License-Identifier: Apache-2.0
import { sentence } from '../../api/problem';
import type { Graph } from '../../api/types';
import { nameOf, placeTitle, withArticle } from '../../lib/whereabouts';
import { inSentence, titled } from '../../lib/words';
import { reasonSentence } from '../../words/reasons';
import type { Journey, Phase } from './journey';

function destinationOf(journey: Journey, graph: Graph | null) {
  return graph?.destinations.find(
    (one) => one.id === journey.destination || (journey.destination === null && one.place === journey.place),
  );
}

/** The name of where a journey goes, for people. */
export function goalName(journey: Journey, graph: Graph | null): string {
  const destination = destinationOf(journey, graph);
  if (destination?.label) return titled(destination.label);
  if (graph && journey.place !== null) return placeTitle(graph, journey.place);
  return 'the place you chose';
}

/** The same inside a sentence: "the kitchen". */
function goalInSentence(journey: Journey, graph: Graph | null): string {
  const label = destinationOf(journey, graph)?.label;
  if (label) return withArticle(inSentence(label));
  const name = graph && journey.place !== null ? nameOf(graph, journey.place) : null;
  return name === null ? 'the place you chose' : withArticle(name);
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
  if (journey.refusal) return sentence(journey.refusal);
  return journey.reason ? reasonSentence(journey.reason) : null;
}

// Of ten arrivals said with 90 % one is somewhere else; of a hundred with 99 % one. Only the first is worth a look.
const kCertain = 0.99;
const kQuiteSure = 0.95;
const kArrived = 0.9;

/** How sure the robot is that it is where it says that it has arrived; null where there is nothing to add, or not known. */
export function arrivalSureness(journey: Journey, graph: Graph | null): string | null {
  const { phase, arrival_probability: probability } = journey;
  if (phase !== 'arrived' || probability === null || probability >= kCertain) return null;
  const goal = goalInSentence(journey, graph);
  if (probability >= kQuiteSure) return `I am quite sure that this is ${goal}.`;
  if (probability >= kArrived) return `I am fairly sure that this is ${goal}. Please have a look.`;
  return `I am not sure that this is ${goal}. Please have a look.`;
}

/** All that a journey says, for those who hear it. */
export function announcement(journey: Journey, graph: Graph | null): string {
  const more = [reasonOf(journey), arrivalSureness(journey, graph)].filter((one) => one !== null).join(' ');
  return more === '' ? heading(journey, graph) : `${heading(journey, graph)}. ${more}`;
}

export function toneOf(phase: Phase): 'good' | 'warn' | 'bad' {
  if (phase === 'refused' || phase === 'failed') return 'bad';
  return phase === 'stopped' ? 'warn' : 'good';
}
