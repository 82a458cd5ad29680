// SPDX-License-Identifier: Apache-2.0
import type { Graph } from '../../api/types';
import { indexOf } from '../../lib/graph_index';

/** So many places around one, the nearest by ways first, without the place itself. */
export function nearestPlaces(graph: Graph, place: string, most: number): string[] {
  const { neighbours, places } = indexOf(graph);
  const seen = new Set([place]);
  let ring = [place];
  while (ring.length > 0 && seen.size <= most) {
    ring = ring
      .flatMap((one) => neighbours.get(one) ?? [])
      .filter((one) => places.has(one) && !seen.has(one));
    for (const one of ring) seen.add(one);
  }
  seen.delete(place);
  return [...seen].slice(0, most);
}
