// SPDX-License-Identifier: Apache-2.0
import type { Destination, Graph, Place } from '../api/types';
import { inSentence } from './words';

/** What a page asks of a graph again and again, found once in linear time; a graph never changes, a newer one comes. */
export interface GraphIndex {
  places: ReadonlyMap<string, Place>;
  place_of_image: ReadonlyMap<string, Place>;
  destinations_at: ReadonlyMap<string, readonly Destination[]>;
  neighbours: ReadonlyMap<string, readonly string[]>; // over ways of either direction
  names: ReadonlyMap<string, string>; // of places that have one, as in a sentence
  nearest_names: ReadonlyMap<string, string>; // of the others, where a named place can be reached
}

const known = new WeakMap<Graph, GraphIndex>();

export function indexOf(graph: Graph): GraphIndex {
  let index = known.get(graph);
  if (!index) known.set(graph, (index = madeFrom(graph)));
  return index;
}

function madeFrom(graph: Graph): GraphIndex {
  const places = new Map(graph.places.map((place) => [place.id, place]));
  const place_of_image = new Map(
    graph.places.flatMap((place) => place.members.map((image) => [image, place] as const)),
  );
  const destinations_at = new Map<string, Destination[]>();
  for (const one of graph.destinations) append(destinations_at, one.place, one);
  const neighbours = new Map<string, string[]>();
  for (const { from, to } of graph.edges) {
    append(neighbours, from, to);
    append(neighbours, to, from);
  }
  const names = new Map<string, string>();
  for (const { id, label } of graph.places) {
    const name = label || destinations_at.get(id)?.[0]?.label;
    if (name !== undefined) names.set(id, inSentence(name));
  }
  const nearest_names = nearestNames(names, neighbours);
  return { places, place_of_image, destinations_at, neighbours, names, nearest_names };
}

/** Breadth first from all named places at once; of two that are equally near, the earlier in the map. */
function nearestNames(
  names: ReadonlyMap<string, string>,
  neighbours: ReadonlyMap<string, readonly string[]>,
): ReadonlyMap<string, string> {
  const found = new Map<string, string>();
  let ring = [...names];
  while (ring.length > 0) {
    const next: [string, string][] = [];
    for (const [place, name] of ring)
      for (const other of neighbours.get(place) ?? []) {
        if (names.has(other) || found.has(other)) continue;
        found.set(other, name);
        next.push([other, name]);
      }
    ring = next;
  }
  return found;
}

function append<T>(lists: Map<string, T[]>, key: string, value: T): void {
  const list = lists.get(key);
  if (list) list.push(value);
  else lists.set(key, [value]);
}
