// SPDX-License-Identifier: Apache-2.0
import type cytoscape from 'cytoscape';
import type { Graph } from '../../api/types';
import type { Spot } from './graph_content';
import { drawnEdges } from './place_views';

/** Spots for a map that gives its places none, by their ways alone. */
export function spotsFor(make: typeof cytoscape, graph: Graph): ReadonlyMap<string, Spot> {
  if (graph.places.every(({ x, y }) => x !== null && y !== null)) return new Map();
  const present = new Set(graph.places.map(({ id }) => id));
  const drawing = make({
    headless: true,
    elements: [
      ...graph.places.map(({ id }) => ({ data: { id } })),
      ...drawnEdges(graph)
        .filter(({ from, to }) => present.has(from) && present.has(to))
        .map(({ id, from, to }) => ({ data: { id, source: from, target: to } })),
    ],
    layout: { name: 'cose', animate: false },
  });
  const spots = new Map(drawing.nodes().map((node) => [node.id(), { ...node.position() }] as const));
  drawing.destroy();
  return spots;
}
