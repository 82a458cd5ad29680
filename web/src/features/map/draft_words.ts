// SPDX-License-Identifier: Apache-2.0
import type { Draft, Graph } from '../../api/types';
import { indexOf } from '../../lib/graph_index';
import { placeTitle } from '../../lib/whereabouts';
import { count } from '../../lib/words';

const kNamedPlaces = 3;

export function draftTitle({ name, by }: Pick<Draft, 'name' | 'by'>): string {
  return name === '' ? `Draft of ${by}` : name;
}

/** "Kitchen, Hall and 4 more places". */
export function touchedWords(places: readonly string[], graph: Graph): string {
  const titles = [
    ...new Set(places.filter((one) => indexOf(graph).places.has(one)).map((one) => placeTitle(graph, one))),
  ];
  const named = titles.slice(0, kNamedPlaces);
  const more = titles.length - named.length;
  const last = more > 0 ? count(more, 'more place') : named.pop();
  return named.length === 0 ? (last ?? '') : `${named.join(', ')} and ${last ?? ''}`;
}

/** A draft of somebody that changes the same places as another. */
export interface Overlap {
  draft: Draft;
  places: readonly string[];
}

/** Found anew from what each draft says that it changes: the other draft may have changed since this one was told. */
export function overlapsWith(draft: Draft, all: readonly Draft[]): Overlap[] {
  const own = new Set(draft.touches);
  return all
    .filter((one) => one.id !== draft.id && one.map === draft.map)
    .map((one) => ({ draft: one, places: one.touches.filter((place) => own.has(place)) }))
    .filter((one) => one.places.length > 0);
}

/** The drafts that change a place, without the one that is open. */
export function draftsAt(place: string, all: readonly Draft[], open: Draft | null): Draft[] {
  return all.filter((one) => one.id !== open?.id && one.touches.includes(place));
}
