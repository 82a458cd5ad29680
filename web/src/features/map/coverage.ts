// SPDX-License-Identifier: Apache-2.0
import type { Graph } from '../../api/types';
import { lineId } from './difference_marks';
import { drawnEdges, type Line } from './place_views';

/** What the tours saw of the house, as far as the map has it. */
export interface Coverage {
  tours: readonly { tour: string; pictures: number; places: number }[]; // those that saw most first
  seen_once: readonly string[]; // places that one tour alone has seen, where there are several
  apart: readonly (readonly string[])[]; // parts that no open way joins to the largest, the largest of them first
  weak: readonly Line[]; // ways that are hard to drive
}

export function coverageOf(graph: Graph): Coverage {
  const pictures = new Map<string, number>();
  const places = new Map<string, number>();
  const add = (counts: Map<string, number>, key: string) => counts.set(key, (counts.get(key) ?? 0) + 1);
  const seen_once: string[] = [];
  for (const { id, members } of graph.places) {
    const own = new Set(members.map(tourOf));
    for (const image of members) add(pictures, tourOf(image));
    for (const tour of own) add(places, tour);
    if (own.size === 1) seen_once.push(id);
  }
  const tours = [...pictures]
    .map(([tour, count]) => ({ tour, pictures: count, places: places.get(tour) ?? 0 }))
    .sort((a, b) => b.pictures - a.pictures || a.tour.localeCompare(b.tour));
  return {
    tours,
    seen_once: tours.length > 1 ? seen_once : [],
    apart: partsOf(graph).slice(1),
    weak: drawnEdges(graph).filter((line) => line.weak),
  };
}

function tourOf(image: string): string {
  return image.split('/')[0] ?? '';
}

/** The parts that open ways join, the largest first. */
function partsOf(graph: Graph): string[][] {
  const open = new Map<string, string[]>();
  const known = new Set<string>();
  for (const { from, to, blocked } of graph.edges) {
    if (blocked || known.has(lineId(from, to))) continue;
    known.add(lineId(from, to));
    open.set(from, [...(open.get(from) ?? []), to]);
    open.set(to, [...(open.get(to) ?? []), from]);
  }
  const seen = new Set<string>();
  const parts = graph.places.flatMap(({ id }) => {
    if (seen.has(id)) return [];
    const part = [id];
    seen.add(id);
    for (const one of part)
      for (const other of open.get(one) ?? [])
        if (!seen.has(other)) {
          seen.add(other);
          part.push(other);
        }
    return [part];
  });
  return parts.sort((a, b) => b.length - a.length);
}
