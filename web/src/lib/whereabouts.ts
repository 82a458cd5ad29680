// SPDX-License-Identifier: Apache-2.0
import type { Belief, Destination, Graph } from '../api/types';
import { indexOf } from './graph_index';
import { inSentence } from './words';

export type Sureness = 'sure' | 'fairly sure' | 'unsure' | 'lost';

/** Where a robot believes to be, in words; `share` is the probability of being there or right beside it. */
export interface Whereabouts {
  sureness: Sureness;
  share: number;
  where: string | null; // completes "I am ...": "in the kitchen", "near the kitchen"
}

// A neighbour is one tour picture away, which for a person is the same spot: a belief's probability counts it already.
const kSureShare = 0.8;
const kFairShare = 0.5;

export function whereabouts(belief: Belief | null, graph: Graph | null): Whereabouts | null {
  if (!belief) return null;
  if (belief.lost) return { sureness: 'lost', share: 0, where: null };
  const { place } = belief;
  if (place === null) return { sureness: 'unsure', share: 0, where: null };
  const share = belief.probability ?? 0;
  const sureness = share >= kSureShare ? 'sure' : share >= kFairShare ? 'fairly sure' : 'unsure';
  return { sureness, share, where: graph ? placeInWords(graph, place) : null };
}

/** "in the kitchen" for a place with a name, "near the kitchen" for one a few steps off, null when nothing is near. */
export function placeInWords(graph: Graph, place: string): string | null {
  const own = nameOf(graph, place);
  if (own !== null) return `in ${withArticle(own)}`;
  const found = nearestNamed(graph, place);
  return found === null ? null : `near ${withArticle(found)}`;
}

/** The name of a place for lists and headings: its own, else how it is told from others, else "Near the kitchen", else its id. */
export function placeTitle(graph: Graph, place: string): string {
  const own = nameOf(graph, place) ?? toldBy(graph, place);
  if (own !== null) return own.charAt(0).toUpperCase() + own.slice(1);
  const near = nearestNamed(graph, place);
  return near === null ? place : `Near ${withArticle(near)}`;
}

export function nameOf(graph: Graph, place: string): string | null {
  return indexOf(graph).names.get(place) ?? null;
}

/**
 * What a destination is called: by the name that people gave its place since the tour; of several in one place, each by
 * its own.
 */
export function destinationLabel(graph: Graph, destination: Destination): string {
  const { place, label } = destination;
  const { places, destinations_at } = indexOf(graph);
  const own = places.get(place)?.label.trim() ?? '';
  const alone = destinations_at.get(place)?.length === 1;
  return alone && own !== '' ? own : label;
}

/** Names of people and things that carry a capital or a possessive go without an article. */
export function withArticle(name: string): string {
  return /^[A-Z]|^(the|my|our) |^\d|'s\b/.test(name) ? name : `the ${name}`;
}

/** "third from the hall towards the study", where the server has such words for a place that nobody has named. */
function toldBy(graph: Graph, place: string): string | null {
  const name = inSentence(indexOf(graph).places.get(place)?.name ?? '');
  return name === '' || name === place ? null : name;
}

/** Both titles, told apart by the ids where they are the same. */
export function titlesApart(graph: Graph, place_a: string, place_b: string): [string, string] {
  const [a, b] = [placeTitle(graph, place_a), placeTitle(graph, place_b)];
  return a === b && place_a !== place_b ? [`${a} (${place_a})`, `${b} (${place_b})`] : [a, b];
}

function nearestNamed(graph: Graph, place: string): string | null {
  return indexOf(graph).nearest_names.get(place) ?? null;
}
