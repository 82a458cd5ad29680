// SPDX-License-Identifier: Apache-2.0
import type { Graph, Robot } from '../../api/types';
import { destinationLabel, withArticle, type Whereabouts } from '../../lib/whereabouts';
import { inSentence, titled } from '../../lib/words';
import { isActive } from './journey';

/** A name on the map that somebody may say the robot is at; all places that carry it are meant. */
export interface Spot {
  label: string; // as it is written in the map
  name: string; // for people
  place: string; // the first of them, and its picture
  image: string;
}

/** Every name of the map once, destinations first. */
export function spotsOf(graph: Graph): Spot[] {
  const spots = new Map<string, Spot>();
  const add = (label: string, place: string, image: string) => {
    const name = titled(label);
    if (name !== '' && !spots.has(label)) spots.set(label, { label, name, place, image });
  };
  for (const one of graph.destinations) add(destinationLabel(graph, one), one.place, one.image);
  for (const one of graph.places) add(one.label, one.id, one.prototype);
  return [...spots.values()];
}

/** Whether the server would hear now where the robot is. */
export function mayBeSaid(robot: Robot, connected: boolean, mayDrive: boolean): boolean {
  return connected && mayDrive && robot.online && robot.map !== null && !isActive(robot.mission?.state);
}

/** Whether the robot would be helped by it: it does not know where it is, or hardly. */
export function needsWord(found: Whereabouts | null): boolean {
  return found === null || found.sureness === 'lost' || found.sureness === 'unsure';
}

export function offerWords(name: string, needed: boolean): string {
  return needed ? `Say where ${name} is` : `${name} is somewhere else`;
}

export function askWords(name: string): string {
  return `Where is ${name}?`;
}

/** What the robot makes of it: pictures of another place overrule what was said. */
export function thanksWords(spot: Spot): string {
  const place = withArticle(inSentence(spot.label));
  return `Thank you. I take it that I am in ${place}, unless I see something else.`;
}
