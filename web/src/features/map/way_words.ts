// SPDX-License-Identifier: Apache-2.0
import type { Edge, Graph } from '../../api/types';
import { percent } from '../../lib/words';

/** One direction of a way; null: the map has no such direction. */
export interface Direction {
  from: string;
  to: string;
  edge: Edge | null;
}

/** Both directions between two places, the one that begins at `place` first. */
export function directionsOf(graph: Graph, place: string, other: string): [Direction, Direction] {
  const edge = (from: string, to: string) =>
    graph.edges.find((one) => one.from === from && one.to === to) ?? null;
  return [
    { from: place, to: other, edge: edge(place, other) },
    { from: other, to: place, edge: edge(other, place) },
  ];
}

function lengthWords({ length_m, length_from }: Edge): string {
  if (length_from === 'unknown') return 'length not known';
  return `${length_from === 'odometry' ? '' : 'about '}${length_m.toFixed(1)} m`;
}

/** What the map knows of one direction: its length, how sure the direction is, and who put it there. */
export function directionWords(edge: Edge | null): string {
  if (!edge) return 'There is no way in this direction.';
  const parts = [
    lengthWords(edge),
    `${percent(edge.confidence)} sure where to head`,
    ...(edge.weak ? ['hard to drive'] : []),
    ...(edge.by === 'person' ? ['put there by a person'] : []),
  ];
  const words = parts.join(', ');
  return `${words.charAt(0).toUpperCase()}${words.slice(1)}.`;
}
