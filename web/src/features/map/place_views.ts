// SPDX-License-Identifier: Apache-2.0
import type { Belief, Edge, Graph } from '../../api/types';
import { nameOf, placeTitle } from '../../lib/whereabouts';

/** A place as the list and the drawing show it. */
export interface PlaceView {
  id: string;
  title: string;
  named: boolean;
  probability: number; // of the robot being there; 0 when unknown
  x: number | null;
  y: number | null;
}

/** All places: those with a name first, by name, then the rest in the order of the map. */
export function placeViews(graph: Graph, belief: Belief | null): PlaceView[] {
  const views = graph.places.map((place) => ({
    id: place.id,
    title: placeTitle(graph, place.id),
    named: nameOf(graph, place.id) !== null,
    probability: probabilityOf(belief, place.id),
    x: place.x,
    y: place.y,
  }));
  return views.sort((a, b) => {
    if (a.named !== b.named) return a.named ? -1 : 1;
    return a.named ? a.title.localeCompare(b.title) : 0;
  });
}

function probabilityOf(belief: Belief | null, place: string): number {
  if (!belief || belief.lost) return 0;
  const found = belief.top.find((one) => one.place === place)?.probability;
  return found ?? (belief.place === place ? (belief.probability ?? 0) : 0);
}

/** Places whose title or id holds every word of `text`. */
export function matching(views: readonly PlaceView[], text: string): PlaceView[] {
  const words = text.toLowerCase().split(/\s+/).filter(Boolean);
  return views.filter((view) =>
    words.every((word) => `${view.title} ${view.id}`.toLowerCase().includes(word)),
  );
}

/** One way out of a place; two directed edges between the same places are one way. */
export interface WayOut {
  other: string;
  length_m: number;
  weak: boolean;
  closed: 'no' | 'one_way' | 'both'; // to no direction that it has, to one of two, or to all
  shortcut: boolean;
}

export function waysOut(graph: Graph, place: string): WayOut[] {
  const ways = new Map<string, WayOut>();
  for (const edge of graph.edges) {
    const other = otherEnd(edge, place);
    if (other === null) continue;
    const seen = ways.get(other);
    ways.set(other, {
      other,
      length_m: seen ? Math.max(seen.length_m, edge.length_m) : edge.length_m,
      weak: edge.weak || (seen?.weak ?? false),
      closed: withDirection(seen?.closed ?? null, edge.blocked),
      shortcut: edge.shortcut,
    });
  }
  return [...ways.values()];
}

/** How closed a way is when one more direction of it is known; null: it is the first. */
function withDirection(before: WayOut['closed'] | null, blocked: boolean): WayOut['closed'] {
  const own = blocked ? 'both' : 'no';
  return before === null || before === own ? own : 'one_way';
}

function otherEnd(edge: Edge, place: string): string | null {
  if (edge.from === place) return edge.to;
  return edge.to === place ? edge.from : null;
}

/** An edge to draw. */
export interface Line {
  id: string;
  from: string;
  to: string;
  weak: boolean;
  closed: WayOut['closed'];
  shortcut: boolean;
}

/** The edges to draw: one line for two directions. */
export function drawnEdges(graph: Graph): Line[] {
  const lines = new Map<string, Line>();
  for (const edge of graph.edges) {
    const id = edge.from < edge.to ? `${edge.from}|${edge.to}` : `${edge.to}|${edge.from}`;
    const seen = lines.get(id);
    lines.set(id, {
      id,
      from: edge.from,
      to: edge.to,
      weak: edge.weak || (seen?.weak ?? false),
      closed: withDirection(seen?.closed ?? null, edge.blocked),
      shortcut: edge.shortcut,
    });
  }
  return [...lines.values()];
}

/** A diameter at which most pictures of places do not overlap, as a share of the drawing's width. */
export function pictureShare(views: readonly PlaceView[]): number {
  const points = views.flatMap((view) =>
    view.x === null || view.y === null ? [] : [{ x: view.x, y: view.y }],
  );
  const nearest = points
    .map((a) => Math.min(...points.filter((b) => b !== a).map((b) => Math.hypot(a.x - b.x, a.y - b.y)), 1))
    .sort((a, b) => a - b);
  const typical = nearest[Math.floor(nearest.length / 4)] ?? 0.2;
  return Math.min(0.14, Math.max(0.03, 0.85 * typical));
}
