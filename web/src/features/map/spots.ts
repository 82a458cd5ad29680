// SPDX-License-Identifier: Apache-2.0
import type cytoscape from 'cytoscape';
import type { Graph } from '../../api/types';
import type { Spot } from './graph_content';
import { drawnEdges } from './place_views';

/**
 * Spots for all places of these states of a map, by their ways alone, where a state gives any of its places none; null: each has
 * one. `diameter`: of a place, in units of the drawing.
 */
export function spotsFor(
  make: typeof cytoscape,
  states: readonly Graph[],
  diameter: number,
): ReadonlyMap<string, Spot> | null {
  const places = states.flatMap((one) => one.places);
  if (places.every(({ x, y }) => x !== null && y !== null)) return null;
  const ids = new Set(places.map(({ id }) => id));
  const ways = new Map(states.flatMap(drawnEdges).map((line) => [line.id, line]));
  const drawing = make({
    headless: true,
    styleEnabled: true, // so that places keep apart by their size
    style: [{ selector: 'node', style: { width: diameter, height: diameter } }],
    elements: [
      ...[...ids].map((id) => ({ data: { id } })),
      ...[...ways.values()]
        .filter(({ from, to }) => ids.has(from) && ids.has(to))
        .map(({ id, from, to }) => ({ data: { id, source: from, target: to } })),
    ],
    layout: { name: 'cose', animate: false },
  });
  const spots = new Map(drawing.nodes().map((node) => [node.id(), { ...node.position() }] as const));
  drawing.destroy();
  return spots;
}
