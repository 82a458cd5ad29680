// SPDX-License-Identifier: Apache-2.0
import { sentence } from '../../api/problem';
import type { Graph, Reason } from '../../api/types';
import { destinationLabel, nameOf, placeTitle, withArticle } from '../../lib/whereabouts';
import { inSentence, timeText, titled } from '../../lib/words';
import { reasonSentence } from '../../words/reasons';
import type { Journey, Phase } from './journey';

/** The label of the destination that a journey leads to; undefined: it leads to none, or to one without a label. */
function labelOf(journey: Journey, graph: Graph | null): string | undefined {
  const found = graph?.destinations.find(
    (one) => one.id === journey.destination || (journey.destination === null && one.place === journey.place),
  );
  return graph && found ? destinationLabel(graph, found) || undefined : undefined;
}

/** The name of where a journey goes, for people. */
export function goalName(journey: Journey, graph: Graph | null): string {
  const label = labelOf(journey, graph);
  if (label) return titled(label);
  if (graph && journey.place !== null) return placeTitle(graph, journey.place);
  return 'the place you chose';
}

/** The same inside a sentence: "the kitchen". */
function goalInSentence(journey: Journey, graph: Graph | null): string {
  const label = labelOf(journey, graph);
  if (label) return withArticle(inSentence(label));
  const name = graph && journey.place !== null ? nameOf(graph, journey.place) : null;
  return name === null ? 'the place you chose' : withArticle(name);
}

/** Ends of a drive that have nothing to do with each other, by the codes that tell of them. */
const kEnds: Readonly<Record<string, 'driver' | 'link' | 'rider'>> = {
  nobody_watching: 'driver',
  driver_gave_back: 'driver',
  robot_gone: 'link',
  robot_connected_anew: 'link',
  link_lost: 'link',
  link_made_anew: 'link',
  server_silent: 'link',
  permit_over: 'link',
  rider_took_over: 'rider',
};

/** How a drive ended that was stopped: by whom, because nobody drove any more, or because the robot could not be reached. */
function stoppedHeading(reason: Reason | null, goal: string): string {
  const by = reason?.parameters.by;
  if (reason?.code === 'stopped_by' && typeof by === 'string')
    return `Stopped by ${by} on the way to ${goal}`;
  if (reason?.code === 'taken_over_by' && typeof by === 'string')
    return `Taken over by ${by} on the way to ${goal}`;
  switch (reason ? kEnds[reason.code] : undefined) {
    case 'driver':
      return `Nobody was driving any more on the way to ${goal}`;
    case 'link':
      return `Connection lost on the way to ${goal}`;
    case 'rider':
      return `The rider took over on the way to ${goal}`;
    default:
      return `Stopped on the way to ${goal}`;
  }
}

const kHeadings: Readonly<Record<Phase, (goal: string, reason: Reason | null) => string>> = {
  asking: (goal) => `Asking to go to ${goal} …`,
  accepted: (goal) => `About to start: ${goal}`,
  driving: (goal) => `On the way to ${goal}`,
  arrived: (goal) => `Arrived: ${goal}`,
  refused: (goal) => `Cannot go to ${goal}`,
  stopped: (goal, reason) => stoppedHeading(reason, goal),
  failed: (goal) => `Did not reach ${goal}`,
};

/** Those of a robot that maps a building by itself. */
const kExploring: Readonly<Record<Phase, string>> = {
  asking: 'Asking …',
  accepted: 'About to map the building by itself',
  driving: 'Maps the building by itself',
  arrived: 'Mapping the building is over',
  refused: 'Cannot map the building by itself',
  stopped: 'Mapping the building was paused',
  failed: 'Mapping the building came to a halt',
};

export function heading(journey: Journey, graph: Graph | null): string {
  if (journey.explores) return kExploring[journey.phase];
  return kHeadings[journey.phase](goalName(journey, graph), journey.reason);
}

/** Who sent it and when, and when it ended; null before there is a mission. */
export function recordWords(journey: Journey, now_ms: number): string | null {
  const { by, created_us, ended_us } = journey;
  if (created_us === null) return null;
  const sent = `Sent ${by ? `by ${by} ` : ''}at ${timeText(created_us, now_ms)}.`;
  return ended_us === null ? sent : `${sent} Ended at ${timeText(ended_us, now_ms)}.`;
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
  if (journey.explores || phase !== 'arrived' || probability === null || probability >= kCertain) return null;
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
